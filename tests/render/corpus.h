// SPDX-License-Identifier: BSD-2-Clause
#pragma once

// What PBRT-v3 renders in spite of a mistake, one small scene for each construct, with the colours it gives.
// To add one: a line in the section of its kind.
#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace pbrtmedia::test {

/// The mean of one of 4 x 4 blocks of the image of 16 x 16 pixels; block (0, 0) is the upper left one.
struct ExpectedBlock {
  int x, y;
  std::array<double, 3> rgb;
};

struct CorpusScene {
  const char* name;
  /// Without "WorldBegin": the world under an infinite light of radiance 0.5, seen by a camera at the origin
  /// of 40 degrees that looks along +z. With it: all but film and sampler, and no light is added.
  std::string text;
  /// A part of the message: a warning, with --strict an error. "": nothing is said.
  std::string said;
  std::vector<ExpectedBlock> blocks;
  std::int64_t samples = 16;  ///< of a pixel, for each of the seeds

  friend std::ostream& operator<<(std::ostream& os, const CorpusScene& scene) { return os << scene.name; }
};

/// A sphere in the middle of the image, its inner blocks (1, 1) to (2, 2) covered, the corners free.
inline const std::string kBall = "Translate 0 0 4 Shape \"sphere\"\n";
inline const std::string kRed = "Material \"matte\" \"rgb Kd\" [ .8 .1 .1 ]\n";
/// The frame that a text without WorldBegin gets, up to its end.
inline const std::string kCamera =
    "Camera \"perspective\" \"float fov\" 40\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [ .5 .5 .5 ]\n";
/// The same for a boundary without material.
inline const std::string kVolpath = "Integrator \"volpath\"\n" + kCamera + "Material \"\"\n";
inline const std::string kCommas =
    "LookAt 0, 0, -4,  0, 0, 0,  0, 1, 0\nCamera \"perspective\" \"float fov\" 40,\nWorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [ .5, .5, .5 ]\nShape \"sphere\"\nWorldEnd\n";
/// What a block shows of the ball by default (Kd 0.5), and of the sky.
inline constexpr std::array<double, 3> kGrey{.25, .25, .25}, kSky{.5, .5, .5};
/// The image of `kBall` alone.
inline const std::vector<ExpectedBlock> kBallOnly{{1, 1, kGrey}, {2, 2, kGrey}, {0, 0, kSky}, {3, 3, kSky}};
/// That of a ball of Kd 0.2.
inline const std::vector<ExpectedBlock> kDarkBall{
    {1, 1, {.1, .1, .1}}, {2, 2, {.1, .1, .1}}, {0, 0, kSky}, {3, 3, kSky}};
/// The image of nothing but the sky.
inline const std::vector<ExpectedBlock> kSkyOnly{{1, 1, kSky}, {2, 2, kSky}, {0, 0, kSky}};

/// A wall at z = 4 before two sheets of one light behind the camera, wide enough for a half space of radiance
/// 1 each: of the nearer one the wall shows 0.5.
inline const std::string kTwoSheets =
    "AttributeBegin Material \"none\" AreaLightSource \"diffuse\" \"bool twosided\" \"true\" "
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 4 5 6 4 6 7 ] \"point P\" [ "
    "-1e5 -1e5 -1 1e5 -1e5 -1 1e5 1e5 -1 -1e5 1e5 -1  -1e5 -1e5 -2 1e5 -1e5 -2 1e5 1e5 -2 -1e5 1e5 -2 ] "
    "AttributeEnd Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
    "\"point P\" [ -9 -9 4 9 -9 4 9 9 4 -9 9 4 ]\n";
inline const std::vector<ExpectedBlock> kWallHalf{
    {0, 0, {.5, .5, .5}}, {1, 1, {.5, .5, .5}}, {2, 2, {.5, .5, .5}}};
/// The layers of a cylinder that emits, in the inner blocks.
inline const std::string kBareLamp =
    "AreaLightSource \"diffuse\" \"rgb L\" [ 3 3 3 ] \"bool twosided\" \"true\" Material \"none\" "
    "Translate 0 0 4 Rotate 90 1 0 0 Shape \"cylinder\"\n";
inline std::string withIntegrator(const std::string& integrator, const std::string& world) {
  return "Integrator \"" + integrator +
         "\" \"integer maxdepth\" 1 Camera \"perspective\" \"float fov\" 40\n" + "WorldBegin\n" + world +
         "WorldEnd\n";
}
/// A medium in [2, 3] seen along z, of extinction 1.
inline const std::string kSlab =
    "Integrator \"volpath\" Camera \"orthographic\" WorldBegin LightSource \"infinite\" \"rgb L\" [ .5 .5 .5 "
    "] "
    "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"string border\" \"clamp\" \"float density\" 1 "
    "\"point p0\" [ -9 -9 2 ] \"point p1\" [ 9 9 3 ] \"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" [ 0 0 0 ]\n";
/// A boundary around [0.1, 1]; `nearWall`: parameters of its first wall.
inline std::string slabBoundary(const std::string& nearWall) {
  const std::string points = "\"point P\" [ -5 -5 .1 5 -5 .1 5 5 .1 -5 5 .1 -5 -5 1 5 -5 1 5 5 1 -5 5 1 ]";
  return "MediumInterface \"m\" \"\" Material \"none\" Shape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 "
         "3 2 ] " +
         points + nearWall + " Shape \"trianglemesh\" " + points +
         " \"integer indices\" [ 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7 ]\n";
}
inline constexpr std::array<double, 3> kDimmed{.18393972, .18393972, .18393972};

inline std::vector<CorpusScene> corpus() {
  return {
      // ---- Text and graphics state.
      {"ball", kBall, "", kBallOnly},
      {"commas", kCommas, "the \",\" behind it", kBallOnly},
      {"junk-behind-number", "Translate 0 0 4.0f Shape \"sphere\"", "the \"f\" behind it", kBallOnly},
      {"hexadecimal", "Translate 0 0 0x4 Shape \"sphere\"", "hexadecimal", kBallOnly},
      {"infinity", "Translate 0 0 4 Shape \"sphere\" \"float zmax\" inf", "largest number", kBallOnly},
      {"end-order",
       "AttributeBegin ObjectBegin \"o\" Shape \"sphere\" AttributeEnd ObjectEnd Translate 0 0 4 "
       "ObjectInstance \"o\"",
       "still open", kBallOnly},
      {"transform-end-order",
       "AttributeBegin TransformBegin Translate 9 9 9 AttributeEnd TransformEnd " + kBall, "still open",
       kBallOnly},
      {"end-without-begin", "AttributeEnd TransformEnd ObjectEnd " + kBall, "without", kBallOnly},
      {"begin-without-end", "AttributeBegin " + kBall, "without AttributeEnd", kBallOnly},
      {"object-in-object", "ObjectBegin \"a\" ObjectBegin \"b\" ObjectEnd " + kBall + " ObjectEnd",
       "inside the definition", kBallOnly},
      {"object-of-itself",
       "ObjectBegin \"a\" " + kBall + " ObjectInstance \"a\" ObjectEnd ObjectInstance \"a\"",
       "contain itself", kBallOnly},
      {"object-unknown", "ObjectInstance \"tree\" " + kBall, "unknown object", kBallOnly},
      {"wrong-block", "Camera \"perspective\" \"float fov\" 3 " + kBall, "belongs before WorldBegin",
       kBallOnly},
      {"include-missing", "Include \"nowhere.pbrt\" " + kBall, "there is no file", kBallOnly},
      {"coordinate-system-unknown", "CoordSysTransform \"nowhere\" " + kBall, "unknown coordinate system",
       kBallOnly},
      {"named-material-unknown",
       kRed + "NamedMaterial \"blue\" " + kBall,
       "unknown material",
       {{1, 1, {.4, .05, .05}}, {0, 0, kSky}}},
      {"named-material-later",
       "NamedMaterial \"red\" " + kBall + " MakeNamedMaterial \"red\" \"string type\" \"mirror\"",
       "unknown material", kBallOnly},
      {"named-material-without-type", "MakeNamedMaterial \"m\" NamedMaterial \"m\" " + kBall, "expected one",
       kSkyOnly},
      {"medium-undefined", kVolpath + "MediumInterface \"smok\" \"\" " + kBall + "WorldEnd",
       "undefined medium", kSkyOnly},
      {"medium-later",
       kVolpath + "MediumInterface \"m\" \"\" " + kBall +
           "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" WorldEnd",
       "defined only at", kSkyOnly},
      {"medium-without-type",
       kVolpath + "MakeNamedMedium \"m\" \"rgb sigma_a\" [ 1 1 1 ] MediumInterface \"m\" \"\" " + kBall +
           "WorldEnd",
       "expected one", kSkyOnly},
      {"singular-shape",
       "AttributeBegin Scale 0 0 0 Shape \"sphere\" \"float radius\" 99 AttributeEnd " + kBall, "no inverse",
       kBallOnly},
      {"singular-instance",
       "ObjectBegin \"o\" Shape \"sphere\" \"float radius\" 99 ObjectEnd AttributeBegin Scale 1 0 1 "
       "ObjectInstance \"o\" AttributeEnd " +
           kBall,
       "no inverse", kBallOnly},
      {"singular-quadric",
       "AttributeBegin Translate 0 0 2 Scale 1 1 0 Shape \"sphere\" \"float radius\" 99 AttributeEnd " +
           kBall,
       "no inverse", kBallOnly},
      {"mesh-pressed-flat",
       "Translate 0 0 4 Scale 1 1 0 Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ "
       "-9 -9 -1  9 -9 1  9 9 1  -9 9 -1 ] \"normal N\" [ 1 0 -1  1 0 -1  1 0 -1  1 0 -1 ]",
       "no inverse",
       {{0, 0, kGrey}, {1, 2, kGrey}, {3, 3, kGrey}}},
      {"number-none",
       "AttributeBegin Translate nan 0 0 Shape \"sphere\" \"float radius\" 99 AttributeEnd " + kBall,
       "not finite", kBallOnly},
      {"view-parallel-to-up", "LookAt 0 0 0  0 1 0  0 1 0 " + kBall, "parallel", kBallOnly},
      {"times-backwards",
       "TransformTimes 1 0 " + kCamera + "ActiveTransform EndTime Translate 99 0 0 ActiveTransform All " +
           kBall + "WorldEnd",
       "lies before the start", kBallOnly},
      {"value-of-wrong-type", "Translate 0 0 4 Shape \"sphere\" \"float radius\" \"2\"", "expected a number",
       kBallOnly},
      {"type-unknown", "Translate 0 0 4 Shape \"sphere\" \"int radius\" 2", "unknown type", kBallOnly},
      {"kind-wrong", "Translate 0 0 4 Shape \"sphere\" \"integer radius\" 2", "found type integer",
       kBallOnly},
      {"several-values", "Translate 0 0 4 Shape \"sphere\" \"float radius\" [ 2 3 ]", "found 2 values",
       kBallOnly},
      {"parameter-unknown", "Translate 0 0 4 Shape \"sphere\" \"float radios\" 2", "unknown parameter",
       kBallOnly},
      {"name-missing", "Translate 0 0 4 Shape \"sphere\" \"float\" 2", "expected a parameter", kBallOnly},
      {"numbers-too-many",
       "Material \"matte\" \"rgb Kd\" [ .8 .1 .1 .3 ] " + kBall,
       "expected a multiple of 3",
       {{1, 1, {.4, .05, .05}}}},
      {"bool-unknown",
       "ReverseOrientation AreaLightSource \"diffuse\" \"rgb L\" [ 3 3 3 ] \"bool twosided\" \"True\" " +
           kBall,
       "takes it as false", kBallOnly},
      {"flavour-unknown", "Texture \"t\" \"colour\" \"constant\" " + kBall, "unknown flavour", kBallOnly},
      {"text-behind-world", kCamera + kBall + "WorldEnd\n% end of file", "unknown directive", kBallOnly},

      // ---- Media and their boundaries.
      // A unit of depth in [2, 3] of the world, however the boundary is placed: exp(-1) / 2.
      {"medium of an instance",
       kSlab + "ObjectBegin \"o\" " + slabBoundary("") +
           "ObjectEnd Scale 1 1 9 ObjectInstance \"o\" WorldEnd",
       "",
       {{1, 1, kDimmed}, {0, 3, kDimmed}}},
      {"medium beside an instance",
       kSlab + "ObjectBegin \"o\" " + slabBoundary("") +
           "ObjectEnd Translate 0 0 6 ObjectInstance \"o\" WorldEnd",
       "",
       {{1, 1, kSky}, {0, 3, kSky}}},
      // Seen through a hole in the near wall, the box is entered nowhere; what is left at the far wall is
      // vacuum.
      {"hole in a boundary",
       kSlab + "Scale 1 1 9 " + slabBoundary(" \"float alpha\" 0 ") + "WorldEnd",
       "",
       {{1, 1, kSky}, {0, 3, kSky}}},

      // ---- Lights and shapes.
      {"light without material path", withIntegrator("path", kTwoSheets), "", kWallHalf},
      {"light without material volpath", withIntegrator("volpath", kTwoSheets), "", kWallHalf},
      {"light without material direct", withIntegrator("directlighting", kTwoSheets), "", kWallHalf},
      {"light without material seen by path",
       withIntegrator("path", kBareLamp),
       "",
       {{1, 1, {6, 6, 6}}, {2, 2, {6, 6, 6}}}},
      {"light without material seen by whitted",
       withIntegrator("whitted", kBareLamp),
       "",
       {{1, 1, {}}, {0, 0, {}}}},
      {"light without material seen directly",
       withIntegrator("directlighting", kBareLamp),
       "",
       {{1, 1, {}}, {2, 2, {}}}},
      {"disk through the camera", "Shape \"disk\" \"float radius\" 2\n", "", kSkyOnly},
      {"sphere through the camera", "Rotate 20 1 2 0 Translate 0 0 -7 Shape \"sphere\" \"float radius\" 7\n",
       "", kSkyOnly},
      {"orthographic camera in a wall",
       "Integrator \"path\" Camera \"orthographic\" WorldBegin LightSource \"infinite\" \"rgb L\" [ .5 .5 .5 "
       "] "
       "Rotate 30 0 0 1 Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
       "\"point P\" [ -9 -9 0 9 -9 0 9 9 0 -9 9 0 ] WorldEnd",
       "", kSkyOnly},
      {"hyperboloid of nothing", "Shape \"hyperboloid\" \"point p1\" [ 1 0 3 ] \"point p2\" [ 0 0 5 ]\n",
       "has no part between the heights", kSkyOnly},

      // ---- Parameters of plugins: textures, materials, meshes, maps.
      {"texture-unknown", "Material \"matte\" \"texture Kd\" \"tower\"\n" + kBall,
       "unknown spectrum texture \"tower\"", kBallOnly},
      {"texture-of-the-other-kind",
       "Texture \"t\" \"float\" \"constant\" \"float value\" .9\n"
       "Material \"matte\" \"texture Kd\" \"t\"\n" +
           kBall,
       "is a float texture", kBallOnly},
      {"texture-name-empty", "Material \"matte\" \"texture Kd\" \"\" \"rgb Kd\" [ .2 .2 .2 ]\n" + kBall, "",
       kDarkBall},
      {"texture-class-unknown",
       "Texture \"t\" \"color\" \"wood\"\nMaterial \"matte\" \"texture Kd\" \"t\"\n" + kBall,
       "unknown type \"wood\"", kBallOnly},
      {"texture-of-the-shape-unknown",
       "Material \"matte\" \"rgb Kd\" [ .2 .2 .2 ]\nTranslate 0 0 4 Shape \"sphere\" \"texture Kd\" "
       "\"nil\"\n",
       "the default is used", kBallOnly},
      {"picture-missing",
       "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"no.exr\" \"float scale\" .4\n"
       "Material \"matte\" \"texture Kd\" \"t\"\n" +
           kBall,
       "a grey picture (0.5) takes its place", kDarkBall},
      {"picture-without-name",
       "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"\"\n"
       "Material \"matte\" \"texture Kd\" \"t\"\n" +
           kBall,
       "a grey picture (0.5) takes its place", kBallOnly},
      {"picture-not-used", "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"no.exr\"\n" + kBall,
       "there is no file", kBallOnly},
      {"spectrum-file-missing",
       "Material \"matte\" \"spectrum Kd\" \"no.spd\"\n" + kBall,
       "there is no file",
       {{1, 1, {0, 0, 0}}, {2, 2, {0, 0, 0}}, {0, 0, kSky}}},
      {"material-unknown", "Material \"wood\" \"rgb Kd\" [ .2 .2 .2 ]\n" + kBall, "unknown type \"wood\"",
       kDarkBall},
      {"mix-of-unknown-materials",
       "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" "
       "\"rgb Kd\" [ .2 .2 .2 ]\n" +
           kBall,
       "unknown material \"a\"", kDarkBall},
      {"map-empty",
       "Camera \"perspective\" \"float fov\" 40\nWorldBegin\n"
       "LightSource \"infinite\" \"rgb L\" [ .5 .5 .5 ] \"string mapname\" [ \"\" ]\n" +
           kBall + "WorldEnd\n",
       "", kBallOnly},
      {"map-missing",
       "Camera \"perspective\" \"float fov\" 40\nWorldBegin\n"
       "LightSource \"infinite\" \"rgb L\" [ .5 .5 .5 ] \"string mapname\" \"no.exr\"\n" +
           kBall + "WorldEnd\n",
       "there is no file", kBallOnly},
      {"light-unknown", "LightSource \"sun\" \"rgb L\" [ 9 9 9 ]\n" + kBall, "unknown type \"sun\"",
       kBallOnly},
      {"light-without-direction", "LightSource \"distant\" \"point to\" [ 0 0 0 ]\n" + kBall,
       "the light is left out", kBallOnly},
      {"shape-unknown", "Shape \"blobby\" \"float width\" 1\n" + kBall, "unknown type \"blobby\"", kBallOnly},
      {"mesh-empty",
       "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 5 5 5 ]\n"
       "Shape \"trianglemesh\" \"point P\" [ ] \"normal N\" [ ] \"float st\" [ ] \"integer indices\" [ ]\n"
       "AttributeEnd\n" +
           kBall,
       "the shape is left out", kBallOnly},
      {"mesh-index-out-of-range",
       "Shape \"trianglemesh\" \"point P\" [ -9 -9 3  9 -9 3  0 9 3 ] \"integer indices\" [ 0 1 3 ]\n" +
           kBall,
       "indices[2] is 3", kBallOnly},
      {"mesh-normals-of-wrong-count",
       "Shape \"trianglemesh\" \"point P\" [ -9 -9 4  9 -9 4  0 18 4 ] \"integer indices\" [ 0 1 2 ] "
       "\"normal N\" [ 0 0 -1 ]\n",
       "the array is left out",
       {{1, 1, kGrey}, {0, 0, kGrey}, {3, 3, kGrey}}},
      {"ply-missing", "Shape \"plymesh\" \"string filename\" \"no.ply\"\n" + kBall, "there is no file",
       kBallOnly},
      {"radius-zero", "Translate 0 0 4 Shape \"sphere\" \"float radius\" 0\n", "the shape is left out",
       kSkyOnly},
      {"medium-unknown",
       "Translate 0 0 4 MakeNamedMedium \"m\" \"string type\" \"cloud\" MediumInterface \"m\" \"\"\n"
       "Material \"\" Shape \"sphere\"\n",
       "unknown type \"cloud\"", kSkyOnly},
      {"density-of-wrong-count",
       "Camera \"perspective\" \"float fov\" 40 Integrator \"volpath\"\nWorldBegin\n"
       "LightSource \"infinite\" \"rgb L\" [ .5 .5 .5 ]\nTranslate -2 -2 3\n"
       "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ 1 1 1 ] \"integer nx\" 2\n"
       "\"float density\" [ 1 1 1 ] \"point p1\" [ 4 4 4 ]\nMediumInterface \"m\" \"\" Material \"\"\n"
       "Translate 2 2 1 Shape \"sphere\"\nWorldEnd\n",
       "the medium is vacuum", kSkyOnly},
      {"medium-broken-and-not-used",
       "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"no.nvdb\"\n" + kBall,
       "nothing uses this medium", kBallOnly},
      {"samples-zero-of-a-light",
       "LightSource \"infinite\" \"rgb L\" [ 0 0 0 ] \"integer samples\" 0\n" + kBall, "taken as 1",
       kBallOnly},

  };
}

/// How an image of ../shared/cases/reference and ours are related.
enum class Relation {
  UpToNoise,    ///< the same image, pixel by pixel
  MeanOnly,     ///< the same mean; pixels differ by more than noise, for a reason that the docs give
  SameSamples,  ///< sampler and number of samples leave nothing random: the same pixels up to rounding
  ByFactor      ///< our answer stays, and a warning says by which factor PBRT-v3 differs
};

/// A scene of ../shared/cases that PBRT-v3 rendered.
struct RenderedScene {
  const char* name;
  Relation relation = Relation::UpToNoise;
  /// ByFactor: a part of the warning; rows of the image, in whose middle half the mean of PBRT-v3's is
  /// `lowest` to `highest` times ours.
  const char* said = "";
  int firstRow = 0, endRow = 0;
  double lowest = 1, highest = 1;

  friend std::ostream& operator<<(std::ostream& os, const RenderedScene& scene) { return os << scene.name; }
};

inline std::vector<RenderedScene> renderedCases() {
  return {
      // ---- Text and graphics state.
      {"commas"},
      {"end-order"},
      {"named-material-unknown"},
      {"singular-transform"},

      // ---- Media and their boundaries.
      {"medium-of-instance-direct"},
      // Samples of a grid below 0 count as 0 before they are interpolated, in PBRT-v3 after (0.08 % of the
      // mean).
      {"density-negative", Relation::MeanOnly},

      // ---- Lights and shapes.
      {"light-mirrored-sphere"},
      {"light-without-material"},
      {"light-without-material-seen"},
      {"surface-through-camera"},
      {"hyperboloid"},
      {"bump-of-instance", Relation::SameSamples},
      // Less than 64 where the sphere that PBRT-v3 samples is near.
      {"light-scaled-sphere", Relation::ByFactor, "with 64 times the area", 4, 16, 0.85 * 64, 64},
      // By about the scale; how far from it depends on how light and surface samples are weighted.
      {"sky-scaled", Relation::ByFactor, "the transformation scales by 0.1", 4, 12, 0.1, 0.15},

      // ---- Parameters of plugins: textures, materials, meshes, maps.
      {"empty-mapname"},
      {"mesh-empty"},
      {"texture-unknown"},
  };
}

}  // namespace pbrtmedia::test
