// SPDX-License-Identifier: BSD-2-Clause
#include "construct/lights.h"

#include "construct/probe.h"
#include "image/image.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

const std::string kOptions =
    "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 Integrator \"volpath\" WorldBegin "
    "Shape \"sphere\" \"float radius\" 0.2\n";

/// A folder with a picture map.pfm whose pixels differ.
class ConstructLight : public testing::Test {
 protected:
  ConstructLight() {
    Image map(4, 2, {"R", "G", "B"});
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 4; ++x)
        map.setRgb(x, y, Rgb(0.1f + static_cast<float>(x), 0.2f + static_cast<float>(y), 1));
    }
    writeImage(folder_.path() / "map.pfm", map);
    folder_.write("broken.pfm", "PF\n4 2\n-1.0\nshort");
  }
  /// The light stands in line 2, column 1.
  Attempt with(const std::string& light, bool quick = false) const {
    return attempt(kOptions + light + "\nWorldEnd", {.build = {.quick = quick}, .folder = folder_.path()});
  }
  auto maker() const {
    return [this](const std::string& light) { return with(light); };
  }
  TemporaryFolder folder_;
};

TEST_F(ConstructLight, EveryParameterHasItsEffect) {
  std::vector<Effect> effects;
  const auto add = [&](const std::string& type, const std::vector<std::string>& parameters) {
    const std::string light = "LightSource \"" + type + '"';
    for (const std::string& p : parameters) effects.push_back({light, light + ' ' + p});
  };
  const std::string map = "\"string mapname\" \"map.pfm\"";
  add("point", {"\"rgb I\" [ 1 2 3 ]", "\"rgb scale\" [ 2 2 2 ]", "\"point from\" [ 1 2 3 ]"});
  add("spot", {"\"blackbody I\" [ 3000 2 ]", "\"rgb scale\" [ 2 1 1 ]", "\"point from\" [ 1 0 -3 ]",
               "\"point to\" [ 1 1 0 ]", "\"float coneangle\" 80", "\"float conedeltaangle\" 20"});
  add("distant", {"\"rgb L\" [ 1 2 3 ]", "\"rgb scale\" [ 2 2 2 ]", "\"point from\" [ 1 2 3 ]",
                  "\"point to\" [ 1 2 3 ]"});
  add("goniometric", {"\"rgb I\" [ 1 2 3 ]", "\"rgb scale\" [ 2 2 2 ]", map});
  add("projection", {"\"rgb I\" [ 1 2 3 ]", "\"rgb scale\" [ 2 2 2 ]", "\"float fov\" 100", map});
  for (const std::string type : {"infinite", "exinfinite"})
    add(type, {"\"rgb L\" [ 1 2 3 ]", "\"rgb scale\" [ 2 2 2 ]", "\"integer samples\" 4",
               "\"integer nsamples\" 4", map});
  for (const std::string light :
       {"\"spot\"", "\"distant\"", "\"goniometric\" \"string mapname\" \"map.pfm\"",
        "\"projection\" \"string mapname\" \"map.pfm\"", "\"infinite\" \"string mapname\" \"map.pfm\""}) {
    effects.push_back({"LightSource " + light, "Rotate 40 1 0 1 LightSource " + light});
  }
  expectEffects(effects, maker(), lights);
  expectSame(
      {{"LightSource \"infinite\" \"integer samples\" 4",
        "LightSource \"infinite\" \"integer nsamples\" 9 \"integer samples\" 4"},
       {"LightSource \"spot\"", "LightSource \"spot\" \"float coneangle\" 30 \"float conedeltaangle\" 5"},
       {"LightSource \"projection\"", "LightSource \"projection\" \"float fov\" 45"},
       {"LightSource \"infinite\"", "LightSource \"exinfinite\" \"rgb L\" [ 1 1 1 ]"}},
      maker(), lights);
}

TEST_F(ConstructLight, APointIsMovedButNotTurnedByItsTransformation) {
  expectSame({{"LightSource \"point\" \"point from\" [ 1 2 3 ]",
               "Translate 1 0 0 Rotate 90 0 0 1 Scale 3 3 3 LightSource \"point\" \"point from\" [ 0 2 3 ]"}},
             maker(), lights);
}

TEST_F(ConstructLight, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{"LightSource \"pint\"", "LightSource: unknown type \"pint\"; did you mean \"point\"?", "t.pbrt:2:13",
        kTolerated},
       {"LightSource \"point\" \"float scale\" 2", "\"scale\": found type float, expected rgb", "t.pbrt:2:21",
        kTolerated},
       {"LightSource \"point\" \"float I\" 2", "LightSource \"point\": parameter \"I\": found type float", "",
        kTolerated},
       {"LightSource \"point\" \"rgb L\" [ 1 1 1 ]", "unknown parameter \"L\"; known: I, scale, from", "",
        kTolerated},
       {"LightSource \"spot\" \"float coneangle\" 200", "found 200, expected in [0, 180]", "t.pbrt:2:38",
        kTolerated},
       {"LightSource \"spot\" \"point to\" [ 0 0 0 ]", "\"from\" and \"to\" are the same point", "t.pbrt:2:1",
        kTolerated},
       {"LightSource \"distant\" \"point to\" [ 0 0 0 ]", "\"from\" and \"to\" are the same point",
        "t.pbrt:2:1", kTolerated},
       {"LightSource \"projection\" \"float fov\" 180", "expected in (0, 180)", "", kTolerated},
       {"LightSource \"infinite\" \"integer samples\" 0", "found 0, expected in [1, ", "", kTolerated},
       {"Scale 0 1 1 LightSource \"point\"", "Scale: the matrix has no inverse", "", kTolerated},
       {"LightSource \"infinite\" \"string mapname\" \"nil.exr\"", "there is no file \"", "t.pbrt:2:41",
        kTolerated},
       {"LightSource \"goniometric\" \"string mapname\" \"broken.pfm\"", "", "", kTolerated},
       {"AreaLightSource \"difuse\" Shape \"disk\"",
        "AreaLightSource: unknown type \"difuse\"; did you mean \"diffuse\"?", "t.pbrt:2:17", kTolerated},
       {"AreaLightSource \"diffuse\" \"float L\" 1 Shape \"disk\"", "found type float, expected rgb", "",
        kTolerated},
       {"AreaLightSource \"diffuse\" \"integer samples\" 0 Shape \"disk\"", "expected in [1, ", "",
        kTolerated},
       {"AreaLightSource \"diffuse\" \"string twosided\" \"true\" Shape \"disk\"",
        "found type string, expected bool", "", kTolerated}},
      maker());
}

TEST_F(ConstructLight, ListsAllMissingFilesTogether) {
  const Attempt a = with(
      "LightSource \"infinite\" \"string mapname\" \"one.exr\"\n"
      "LightSource \"goniometric\" \"string mapname\" \"two.exr\"\n"
      "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"three.exr\"\n"
      "Shape \"plymesh\" \"string filename\" \"four.ply\"");
  for (const std::string name : {"one.exr", "two.exr", "three.exr", "four.ply"})
    EXPECT_TRUE(a.warns(name)) << name << '\n' << a.messages();
}

TEST_F(ConstructLight, LeavesUnknownLightsOut) {
  const Attempt a = with("LightSource \"sky\" LightSource \"point\" \"float scale\" 3");
  ASSERT_TRUE(a.warns("unknown type \"sky\"")) << a.messages();
  EXPECT_TRUE(a.warns("\"scale\": found type float"));
  EXPECT_EQ(lights(a), lights(with("LightSource \"point\"")));
  const Attempt area = with("LightSource \"point\" AreaLightSource \"x\" Shape \"disk\"");
  ASSERT_TRUE(area.warns("unknown type \"x\"")) << area.messages();
  EXPECT_EQ(area.made->scene->lights().size(), 1u);
}

TEST_F(ConstructLight, WarnsThatLightsDoNotMove) {
  EXPECT_TRUE(
      with("ActiveTransform EndTime Translate 1 0 0 LightSource \"point\"").warns("lights do not move"));
}

TEST_F(ConstructLight, QuickDividesTheNumberOfSamplesByFour) {
  const auto samplesOf = [&](const std::string& light) {
    const Attempt a = with(light, true);
    EXPECT_TRUE(a.made.has_value()) << a.messages();
    return a.made->scene->lights().at(0)->sampleCount();
  };
  EXPECT_EQ(samplesOf("LightSource \"infinite\" \"integer samples\" 16"), 4);
  EXPECT_EQ(samplesOf("LightSource \"infinite\" \"integer samples\" 2"), 1);
  EXPECT_EQ(samplesOf("AreaLightSource \"diffuse\" \"integer samples\" 8 Shape \"disk\""), 2);
}

TEST_F(ConstructLight, EveryParameterOfAreaLightsHasItsEffect) {
  const std::string disk = " Translate 0 0 0.5 Shape \"disk\"";
  std::vector<Effect> effects, aliases;
  for (const std::string p : {"\"rgb L\" [ 1 2 3 ]", "\"rgb scale\" [ 2 2 2 ]", "\"bool twosided\" \"true\"",
                              "\"integer samples\" 5", "\"integer nsamples\" 5"}) {
    effects.push_back({"AreaLightSource \"diffuse\"" + disk, "AreaLightSource \"diffuse\" " + p + disk});
    aliases.push_back({"AreaLightSource \"area\" " + p + disk, "AreaLightSource \"diffuse\" " + p + disk});
  }
  expectEffects(effects, maker(), lights);
  expectSame(aliases, maker(), lights);
  expectEffects({effects[2]}, maker(), surfaces);
  expectEffects({{"AreaLightSource \"area\"" + disk, "AreaLightSource \"area\" ReverseOrientation" + disk}},
                maker(), surfaces);
}

TEST_F(ConstructLight, SaysByWhichFactorPbrtDiffers) {
  const StrictAttempts strict;  // our answer stays, so it is no error
  const std::string area = "AreaLightSource \"diffuse\" ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"Scale .125 .125 .125 " + area + "Shape \"sphere\"", "with 64 times the area"},
      {"Scale 2 2 2 " + area + "Shape \"sphere\"", "with 0.25 times the area"},
      {area + "Shape \"sphere\" \"float zmin\" 0", "with 2 times the area"},
      {"Scale .5 .5 .5 " + area + "Shape \"sphere\" \"float phimax\" 180", "with 8 times the area"},
      {"Scale .5 1 1 " + area + "Shape \"cylinder\"", "scales it, 1.3 times the area"},
      {"Scale .5 .25 9 " + area + "Shape \"disk\"", "scales it, 8 times the area"},
      {"Scale .1 .1 .1 LightSource \"infinite\"", "the transformation scales by 0.1"},
      {"Scale 1 4 1 LightSource \"exinfinite\"", "the transformation scales by 4"},
  };
  for (const auto& [light, said] : cases) {
    const Attempt a = with(light);
    EXPECT_TRUE(a.warns(said)) << light << '\n' << a.messages();
  }
}

TEST_F(ConstructLight, SaysWhereTheSideThatIlluminatesIsNotTheOneThatIsSeen) {
  const std::string area = "AreaLightSource \"diffuse\" ", mirror = "Scale -1 1 1 ";
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ] ";
  const std::string withN = mesh + "\"normal N\" [ 0 0 1 0 0 1 0 0 1 ]";
  for (const std::string& light : {mirror + area + "Shape \"sphere\"", mirror + area + "Shape \"cone\"",
                                   "ReverseOrientation " + area + withN}) {
    EXPECT_TRUE(with(light).warns("as in PBRT-v3 light samples find the side")) << light;
    const StrictAttempts strict;
    EXPECT_TRUE(with(light).failsWith("as in PBRT-v3 light samples find the side")) << light;
  }
}

TEST_F(ConstructLight, SaysNothingOfLightsThatPbrtRendersAsWell) {
  const std::string area = "AreaLightSource \"diffuse\" ";
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ] "
      "\"normal N\" [ 0 0 1 0 0 1 0 0 1 ]";
  const std::vector<std::string> silent = {
      "Rotate 40 1 2 3 Translate 1 2 3 " + area + "Shape \"sphere\" \"float radius\" .125",
      "Rotate 40 1 2 3 LightSource \"infinite\"",
      "Scale -1 1 1 LightSource \"infinite\"",
      "Scale -2 2 2 " + area + mesh,
      "ReverseOrientation " + area + "Shape \"disk\"",
      "ReverseOrientation AreaLightSource \"diffuse\" \"bool twosided\" \"true\" " + mesh,
      "Scale -1 1 1 AreaLightSource \"diffuse\" \"bool twosided\" \"true\" Shape \"sphere\""};
  for (const std::string& light : silent) {
    const Attempt a = with(light);
    EXPECT_TRUE(a.isSilent()) << light << '\n' << a.messages();
  }
}

TEST_F(ConstructLight, SaysThatALightTakesLightAway) {
  for (const char* light : {"LightSource \"point\" \"rgb I\" [ -1 -1 -1 ]",
                            "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ] \"rgb scale\" [ -2 -2 -2 ]",
                            "AreaLightSource \"diffuse\" \"rgb L\" [ -1 -1 -1 ] Shape \"sphere\""}) {
    const Attempt a = attemptWorld(light);
    EXPECT_TRUE(a.warns("a light that takes light away")) << light << a.messages();
  }
  // One channel beyond what RGB can hold is no such light.
  EXPECT_TRUE(attemptWorld("LightSource \"point\" \"blackbody I\" [ 1200 1 ]").isSilent());
  EXPECT_TRUE(
      attemptWorld("LightSource \"point\" \"rgb I\" [ -1 -1 -1 ] \"rgb scale\" [ -1 -1 -1 ]").isSilent());
}

}  // namespace
}  // namespace pbrtmedia::test
