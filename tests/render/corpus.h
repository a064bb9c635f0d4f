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
/// What a block shows of the ball by default (Kd 0.5), and of the sky.
inline constexpr std::array<double, 3> kGrey{.25, .25, .25}, kSky{.5, .5, .5};
/// The image of `kBall` alone.
inline const std::vector<ExpectedBlock> kBallOnly{{1, 1, kGrey}, {2, 2, kGrey}, {0, 0, kSky}, {3, 3, kSky}};
/// That of a ball of Kd 0.2.
inline const std::vector<ExpectedBlock> kDarkBall{
    {1, 1, {.1, .1, .1}}, {2, 2, {.1, .1, .1}}, {0, 0, kSky}, {3, 3, kSky}};
/// The image of nothing but the sky.
inline const std::vector<ExpectedBlock> kSkyOnly{{1, 1, kSky}, {2, 2, kSky}, {0, 0, kSky}};

inline std::vector<CorpusScene> corpus() {
  return {
      // ---- Text and graphics state.
      {"ball", kBall, "", kBallOnly},

      // ---- Media and their boundaries.

      // ---- Lights and shapes.

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
      {"shape-unknown", "Shape \"curve\" \"float width\" 1\n" + kBall, "unknown type \"curve\"", kBallOnly},
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

/// The scenes of ../shared/cases that PBRT-v3 rendered: each is compared with its image.
inline std::vector<const char*> renderedCases() {
  return {
      // ---- Text and graphics state.

      // ---- Media and their boundaries.
      "medium-of-instance-direct",

      // ---- Lights and shapes.

      // ---- Parameters of plugins: textures, materials, meshes, maps.
      "density-negative",
      "empty-mapname",
      "mesh-empty",
      "texture-unknown",

  };
}

}  // namespace pbrtmedia::test
