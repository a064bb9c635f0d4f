// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "support/render_scene.h"

// Small scenes that all integrators render to the same image.
namespace pbrtmedia::test {

inline constexpr int kAgreementResolution = 5;
struct AgreementScene {
  const char* name;
  std::string world;
  int samples = 32;       ///< per seed and pixel
  std::string view = "";  ///< before the camera
  int maxDepth = 4;
  const char* camera = "\"perspective\" \"float fov\" 40";
  double tooBright = 1.05;  ///< what a difference of light must not get away with
  friend std::ostream& operator<<(std::ostream& os, const AgreementScene& s) { return os << s.name; }
};

inline const std::string kFloor =
    "Material \"matte\" \"rgb Kd\" [ .7 .6 .5 ]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 -2 0 2 -2 0 2 2 0 -2 2 0 ]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 1.5 0 2 1.5 0 2 1.5 3 -2 "
    "1.5 3 ]\n";
inline const std::string kBall =
    "AttributeBegin\nMaterial \"plastic\" \"rgb Kd\" [ .2 .3 .5 ] \"float roughness\" .2\n"
    "Translate .5 .3 .6\nShape \"sphere\" \"float radius\" .5\nAttributeEnd\n";
inline const std::string kLamp =
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 9 8 6 ]\nMaterial \"matte\" \"rgb Kd\" [ .3 .3 "
    ".3 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2 ] \"point P\" [ -.6 -.6 2.6 .6 -.6 2.6 "
    ".6 .6 2.6 -.6 .6 2.6 ]\nAttributeEnd\n";
inline const std::string kSmoke =
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .2 .2 .2 "
    "] \"rgb sigma_s\" [ 1.4 1.4 1.4 ] \"float g\" .4\n";

inline const std::string kThin =
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .1 .1 .1 "
    "] \"rgb sigma_s\" [ .3 .3 .3 ]\n";

inline std::string inBox(const std::string& medium, const std::string& name = "m") {
  return medium + mediumBox(name, {-.8, -.8, .2}, {.8, .8, 1.6});
}
inline std::string gridMedium(const std::string& extra = "") {
  std::string text =
      "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ .3 .3 .3 ] \"rgb sigma_s\" "
      "[ 3 3 3 ] \"integer nx\" 3 \"integer ny\" 3 \"integer nz\" 3 \"point p0\" [ -.8 -.8 .2 ] \"point p1\" "
      "[ .8 .8 1.6 ] \"float density\" [ ";
  Rng rng(3);
  for (int i = 0; i < 27; ++i) text += std::to_string(i % 4 == 0 ? 0 : 2 * rng.uniform()) + ' ';
  return text + "] " + extra + '\n';
}

/// A loose mat of strands in two directions.
inline std::string strands(const std::string& type) {
  std::string text;
  for (int i = 0; i < 7; ++i) {
    const std::string a = std::to_string(-.6 + .2 * i);
    for (const bool across : {false, true}) {
      const auto point = [&](const char* along, const char* z) {
        return (across ? a + ' ' + along : along + (' ' + a)) + ' ' + z + ' ';
      };
      text += "Shape \"curve\" \"string type\" \"" + type + "\" \"float width\" .12 \"point P\" [ " +
              point("-.8", ".7") + point("-.3", "1.1") + point(".3", "1.1") + point(".8", ".7") + "]" +
              (type == "ribbon" ? " \"normal N\" [ 0 -.6 .8  .3 -.4 1 ]\n" : "\n");
    }
  }
  return text;
}

inline std::vector<AgreementScene> agreementScenes() {
  const std::string point = "LightSource \"point\" \"point from\" [ -.6 -.5 2 ] \"rgb I\" [ 5 4 3 ]\n";
  const std::string surfaces = kFloor + kBall;
  const std::string chromatic =
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .1 .3 .6 ] \"rgb sigma_s\" [ "
      "2 1 .6 ]\n";
  const std::string rough = "Material \"glass\" \"float uroughness\" .4 \"float vroughness\" .4\n";
  return {
      {"area", surfaces + kLamp},
      {"point", surfaces + point},
      {"spot", surfaces +
                   "LightSource \"spot\" \"point from\" [ -.6 -.5 2 ] \"point to\" [ .2 .2 0 ] \"rgb I\" "
                   "[ 7 6 5 ] \"float coneangle\" 40 \"float conedeltaangle\" 10\n"},
      {"distant", surfaces + "LightSource \"distant\" \"point from\" [ -1 -2 3 ] \"rgb L\" [ 2 2 1 ]\n"},
      {"infinite", surfaces + kWhiteEnvironment},
      {"mirror",
       surfaces + kLamp +
           "AttributeBegin\nMaterial \"mirror\"\nTranslate -.6 .2 .6\nShape \"sphere\" \"float "
           "radius\" .4\nAttributeEnd\n",
       64},
      {"sphereLight", surfaces +
                          "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 20 18 12 ]\n"
                          "Translate -.6 -.4 2.6\nShape \"sphere\" \"float radius\" .2\nAttributeEnd\n"},
      {"lampWithoutMaterial",
       kFloor +
           "AttributeBegin\nMaterial \"none\"\nAreaLightSource \"diffuse\" \"rgb L\" [ 6 5 4 ] \"bool "
           "twosided\" \"true\"\nTranslate 0 0 2.9\nShape \"sphere\" \"float radius\" .3\nAttributeEnd\n"},
      {"severalLights", surfaces + kLamp + point + kWhiteEnvironment},
      {"homogeneous", kFloor + kLamp + inBox(kSmoke)},
      {"homogeneousUnderAPoint", kFloor + point + inBox(kSmoke)},
      {"homogeneousUnderTheSky", kFloor + kWhiteEnvironment + inBox(kSmoke)},
      {"homogeneousUnderTheSun",
       kFloor + "LightSource \"distant\" \"point from\" [ -1 -2 3 ] \"rgb L\" [ 2 2 1 ]\n" + inBox(kSmoke)},
      {"grid", kFloor + kLamp + inBox(gridMedium())},
      {"gridWithLearnedBounds", kFloor + point + inBox(gridMedium("\"string bounds\" \"progressive\" "))},
      {"chromatic", kFloor + kLamp + inBox(chromatic), 64},
      {"emissive",
       kFloor + point +
           inBox("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb Le\" [ 1 .6 .3 ] "
                 "\"rgb sigma_a\" [ .6 .6 .6 ] \"rgb sigma_s\" [ .8 .8 .8 ]\n"),
       64},
      {"flame", kFloor + kBall + inBox(gridMedium("\"rgb Le\" [ 4 2.5 1.5 ] ")), 64},
      {"placedFlames",
       "ObjectBegin \"flame\"\n" + inBox(gridMedium("\"rgb Le\" [ 6 4 3 ] ")) + "ObjectEnd\n" + kFloor +
           point +
           "AttributeBegin Translate -.5 .4 0 Scale .5 .5 .5 ObjectInstance \"flame\" AttributeEnd\n"
           "AttributeBegin Translate .5 0 -.1 Scale .6 .6 1.2 ObjectInstance \"flame\" AttributeEnd\n",
       64},
      {"subsurface",
       kFloor + kLamp +
           "AttributeBegin Material \"subsurface\" \"float eta\" 1.3 \"rgb sigma_a\" [ .2 .5 1 ] \"rgb "
           "sigma_s\" [ 9 8 7 ] Translate 0 .2 .8 Shape \"sphere\" \"float radius\" .6 AttributeEnd\n",
       64},
      {"roughSubsurfaceInFog",
       kFloor + point + kThin + mediumBox("m", {-1.5, -1.5, .1}, {1.5, 1.4, 1.9}) +
           "AttributeBegin MediumInterface \"\" \"m\" Material \"kdsubsurface\" \"rgb Kd\" [ .7 .5 .3 ] "
           "\"rgb "
           "mfp\" [ .1 .1 .1 ] \"float uroughness\" .3 \"float vroughness\" .3 Translate 0 .2 .8 Shape "
           "\"sphere\" \"float radius\" .6 AttributeEnd\n",
       64},
      {"hair",
       kFloor + kLamp +
           "AttributeBegin Material \"hair\" \"rgb sigma_a\" [ .05 .1 .2 ] \"float beta_m\" .6 \"float "
           "beta_n\" .6 " +
           strands("flat") + "AttributeEnd\n",
       64},
      {"ribbons", kFloor + kLamp + strands("ribbon"), 64},
      {.name = "fogAlone", .world = point + inBox(kSmoke), .samples = 96, .tooBright = 1.1},
      {"mixedLobes",
       "Material \"uber\" \"rgb Kd\" [ .5 .4 .3 ] \"rgb Kr\" [ .3 .3 .3 ] \"rgb Ks\" [ 0 0 0 ]\n"
       "Shape \"disk\" \"float radius\" 2\nTranslate 0 .2 .7 Shape \"sphere\" \"float radius\" .6\n"
       "Translate 0 -.2 -.7\n" +
           point,
       64},
      {"overlapping",
       kFloor + kLamp +
           "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .1 .1 .1 ] "
           "\"rgb sigma_s\" [ 1 1 1 ] \"string overlap\" \"add\" \"float g\" .6\n" +
           mediumBox("a", {-1, -1, .1}, {.3, .9, 1.2}) +
           "MakeNamedMedium \"b\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .4 .4 .4 ] \"rgb "
           "sigma_s\" "
           "[ 2 2 2 ] \"string overlap\" \"add\" \"float g\" -.5\n" +
           mediumBox("b", {-.4, -1, .3}, {.9, .8, 1.7}),
       64},
      {"roughGlassAroundAMedium",
       kFloor + kLamp + kSmoke + "AttributeBegin\nMediumInterface \"m\" \"\"\n" + rough +
           "Translate 0 0 .8\nShape \"sphere\" \"float radius\" .6\nAttributeEnd\n",
       128},
      {"glassAroundAMediumUnderTheSky",
       kFloor + kWhiteEnvironment + kSmoke +
           "AttributeBegin\nMediumInterface \"m\" \"\"\nMaterial \"glass\"\n"
           "Translate 0 0 .8\nShape \"sphere\" \"float radius\" .6\nAttributeEnd\n",
       256},
      {"cameraInside", kFloor + point + kThin + mediumBox("m", {-1.9, -4.5, .1}, {1.9, 1.4, 1.9}), 64},
      {"cameraAndLampInEndlessFog", kFloor + point + kBall, 64,
       "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .05 .05 .05 ] \"rgb "
       "sigma_s\" [ .2 .2 .2 ]\nMediumInterface \"\" \"fog\"\n"},
      {"lampInTheMedium", kFloor + kThin + mediumBox("m", {-1.2, -1.2, .2}, {1.2, 1.2, 2.8}) + kLamp, 64},
      {"lampAtTheHeightOfTheCamera",
       kFloor +
           "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 9 8 6 ]\nMaterial \"matte\" \"rgb Kd\" [ "
           ".3 "
           ".3 .3 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2 ] \"point P\" [ -.6 -.6 1.6 .6 "
           "-.6 1.6 .6 .6 1.6 -.6 .6 1.6 ]\nAttributeEnd\n" +
           kThin + mediumBox("m", {-.8, -.8, .2}, {.8, .8, 1.3})},
      {"otherLaw", kFloor + kLamp + inBox(gridMedium("\"string law\" \"linear\" ")), 64},
      {"lens", kFloor + kLamp + kBall + inBox(kThin), 64, "", 3,
       "\"perspective\" \"float fov\" 40 \"float lensradius\" .2 \"float focaldistance\" 4"},
      {"orthographic", kFloor + kLamp + kBall + inBox(kThin), 64, "", 3,
       "\"orthographic\" \"float screenwindow\" [ -1.5 1.5 -1.5 1.5 ]"},
      {"environment", kFloor + point + kBall + inBox(kThin), 256, "", 3, "\"environment\""},
  };
}

inline std::string textOf(const AgreementScene& scene, const std::string& integrator, double light = 1,
                          const std::string& parameters = "", int resolution = kAgreementResolution) {
  std::ostringstream os;
  os << "Film \"image\" \"integer xresolution\" " << resolution << " \"integer yresolution\" " << resolution
     << " \"float scale\" " << light << " \"string filename\" \"unused.exr\"\nPixelFilter \"box\"\n"
     << "Sampler \"random\" \"integer pixelsamples\" " << scene.samples << "\nIntegrator \"" << integrator
     << "\" \"integer maxdepth\" " << scene.maxDepth << ' ' << parameters
     << "\nLookAt 0 -4 1.6  0 0 .9  0 0 1\n"
     << scene.view << "Camera " << scene.camera << "\nWorldBegin\n"
     << scene.world << "WorldEnd\n";
  return os.str();
}

}  // namespace pbrtmedia::test
