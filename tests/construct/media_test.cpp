// SPDX-License-Identifier: BSD-2-Clause
#include "construct/media.h"

#include <set>
#include <string_view>

#include "construct/probe.h"
#include "media/medium.h"
#include "media/phase/henyey_greenstein.h"
#include "media/presets.h"

namespace pbrtmedia::test {
namespace {

const std::string kGrid =
    "\"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 3 "
    "\"float density\" [ 0.1 0.2 0.3 0.4 0.5 0.6 ] ";
const std::string kHomogeneous = "\"string type\" \"homogeneous\" ";

/// A medium "m" in a sphere; MakeNamedMedium stands in line 2, column 1.
Attempt with(const std::string& parameters) {
  return attemptWorld("MakeNamedMedium \"m\" " + parameters +
                      "\nMediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"");
}
Attempt under(const std::string& transformations) {
  return attemptWorld(transformations + " MakeNamedMedium \"m\" " + kGrid +
                      "\nIdentity MediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"");
}

TEST(ConstructMedium, SamplesBelowZeroAreZeroBeforeTheyAreInterpolated) {
  const auto densityAt = [](const std::string& samples, Point3f p) {
    const Attempt a = with(
        "\"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 1 "
        "\"string border\" \"clamp\" \"rgb sigma_s\" [ 1 1 1 ] \"float density\" " +
        samples);
    RenderCounters counters;
    return a.made->scene->media()[0]->at(p, counters).sigmaS.r;
  };
  // Sample centres are at x = 1/4 and 3/4. Cut afterwards, as in PBRT-v3, it were .25 in the middle.
  EXPECT_EQ(densityAt("[ -.5 1 ]", {.5f, .5f, .5f}), .5f);
  for (int i = 0; i <= 16; ++i) {
    const Point3f p{static_cast<float>(i) / 16, .5f, .25f};
    EXPECT_EQ(densityAt("[ -.5 1 ]", p), densityAt("[ 0 1 ]", p)) << p;
  }
}

TEST(ConstructMedium, EveryParameterHasItsEffect) {
  std::vector<Effect> effects;
  for (const std::string& type : {kHomogeneous, kGrid}) {
    for (const std::string p : {"\"rgb sigma_a\" [ 1 2 3 ]", "\"rgb sigma_s\" [ 1 2 3 ]",
                                "\"float scale\" 0.1", "\"float g\" 0.5", "\"string phase\" \"rayleigh\"",
                                "\"string phase\" [ \"henyeygreenstein\" \"rayleigh\" ] \"float g\" 0.7",
                                "\"string preset\" \"Ketchup\"", "\"string overlap\" \"add\"",
                                "\"string overlap\" \"priority\"", "\"integer priority\" 3"}) {
      effects.push_back({type, type + p});
    }
  }
  for (const std::string p :
       {"\"point p0\" [ -1 0 0 ]", "\"point p1\" [ 2 1 1 ]", "\"string border\" \"clamp\""})
    effects.push_back({kGrid, kGrid + p});
  effects.push_back({kGrid,
                     "\"string type\" \"heterogeneous\" \"integer nx\" 3 \"integer ny\" 2 "
                     "\"float density\" [ 0.1 0.2 0.3 0.4 0.5 0.6 ] "});
  expectEffects(effects, with, media);
  expectSame({{kHomogeneous, kHomogeneous +
                                 "\"rgb sigma_a\" [ .0011 .0024 .014 ] \"rgb sigma_s\" [ 2.55 3.21 3.77 ] "
                                 "\"float g\" 0 \"float scale\" 1 \"string overlap\" \"boundary\""},
              {kHomogeneous + "\"float g\" .5",
               kHomogeneous + "\"string phase\" [ \"henyeygreenstein\" \"isotropic\" ] \"float g\" .5 "
                              "\"float phaseweight\" [ 1 0 ]"},
              {kHomogeneous, kHomogeneous + "\"string phase\" \"isotropic\""},
              {kHomogeneous, kHomogeneous + "\"string preset\" \"Wholemilk\""},
              {kHomogeneous + "\"rgb sigma_a\" [ 2 4 6 ] \"rgb sigma_s\" [ 3 2 1 ]",
               kHomogeneous + "\"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 1.5 1 0.5 ] \"float scale\" 2"},
              {kHomogeneous + "\"integer priority\" 2",
               kHomogeneous + "\"string overlap\" \"priority\" \"integer priority\" 2"},
              {kHomogeneous + "\"string preset\" \"Skin1\" \"rgb sigma_a\" [ 1 2 3 ]",
               kHomogeneous + "\"rgb sigma_s\" [ 0.74 0.88 1.01 ] \"rgb sigma_a\" [ 1 2 3 ]"},
              {kGrid, kGrid + "\"point p0\" [ 0 0 0 ] \"point p1\" [ 1 1 1 ] \"string border\" \"zero\""}},
             with, media);
}

TEST(ConstructMedium, EveryLobeHasItsOwnAsymmetry) {
  const Attempt a = with(kHomogeneous +
                         "\"string phase\" [ \"henyeygreenstein\" \"isotropic\" \"henyeygreenstein\" ] "
                         "\"float g\" [ 0.5 -0.3 ] \"float phaseweight\" [ 1 0 3 ]");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  const PhaseFunction& phase = a.made->scene->media()[0]->phase();
  const Vector3f wo(0, 0, 1);
  for (const Vector3f wi : {Vector3f(0, 0, 1), Vector3f(0, 0, -1), Vector3f(0, 0.6f, 0.8f)}) {
    const float expected =
        0.25f * HenyeyGreenstein(0.5f).evaluate(wo, wi) + 0.75f * HenyeyGreenstein(-0.3f).evaluate(wo, wi);
    EXPECT_NEAR(phase.evaluate(wo, wi), expected, 1e-6f) << wi;
  }
}

TEST(ConstructMedium, KnowsEveryPresetOfPbrt) {
  constexpr std::string_view kNames[] = {"Apple",
                                         "Chicken1",
                                         "Chicken2",
                                         "Cream",
                                         "Ketchup",
                                         "Marble",
                                         "Potato",
                                         "Skimmilk",
                                         "Skin1",
                                         "Skin2",
                                         "Spectralon",
                                         "Wholemilk",
                                         "Lowfat Milk",
                                         "Reduced Milk",
                                         "Regular Milk",
                                         "Espresso",
                                         "Mint Mocha Coffee",
                                         "Lowfat Soy Milk",
                                         "Regular Soy Milk",
                                         "Lowfat Chocolate Milk",
                                         "Regular Chocolate Milk",
                                         "Coke",
                                         "Pepsi",
                                         "Sprite",
                                         "Gatorade",
                                         "Chardonnay",
                                         "White Zinfandel",
                                         "Merlot",
                                         "Budweiser Beer",
                                         "Coors Light Beer",
                                         "Clorox",
                                         "Apple Juice",
                                         "Cranberry Juice",
                                         "Grape Juice",
                                         "Ruby Grapefruit Juice",
                                         "White Grapefruit Juice",
                                         "Shampoo",
                                         "Strawberry Shampoo",
                                         "Head & Shoulders Shampoo",
                                         "Lemon Tea Powder",
                                         "Orange Powder",
                                         "Pink Lemonade Powder",
                                         "Cappuccino Powder",
                                         "Salt Powder",
                                         "Sugar Powder",
                                         "Suisse Mocha Powder",
                                         "Pacific Ocean Surface Water"};
  std::set<Numbers> different;
  for (const std::string_view name : kNames) {
    const Attempt a = with(kHomogeneous + "\"string preset\" \"" + std::string(name) + '"');
    ASSERT_TRUE(a.isSilent()) << name << a.messages();
    different.insert(media(a));
  }
  EXPECT_EQ(different.size(), std::size(kNames)) << "each has its own numbers";
  EXPECT_EQ(std::size(kNames), mediumPresets().size());
}

TEST(ConstructMedium, KnowsEveryPresetOfItsList) {
  for (const MediumPreset& preset : mediumPresets()) {
    const Attempt a = with(kHomogeneous + "\"string preset\" \"" + std::string(preset.name) + '"');
    EXPECT_TRUE(a.isSilent()) << preset.name << a.messages();
  }
}

TEST(ConstructMedium, AGridStandsWhereItsDirectiveStands) {
  expectEffects({{"", "Translate 0 0 0.4"}, {"", "Scale 2 1 1"}, {"", "Rotate 30 1 0 0"}}, under, media);
  EXPECT_TRUE(under("ActiveTransform EndTime Translate 0 0 1").warns("media do not move"));
}

TEST(ConstructMedium, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{"\"string type\" \"homogenous\"",
        "medium \"m\": unknown type \"homogenous\"; did you mean \"homogeneous\"?", "t.pbrt:2:35",
        kTolerated},
       {kHomogeneous + "\"float sigma_s\" 1", "\"sigma_s\": found type float, expected rgb", "", kTolerated},
       {kHomogeneous + "\"rgb sigma_a\" [ 1 -1 1 ]",
        "\"sigma_a\": has the RGB value (1, -1, 1); its negative channels count as 0", "", kTolerated},
       {kHomogeneous + "\"float scale\" -1", "expected >= 0", ""},
       {kHomogeneous + "\"float g\" 1", "\"g\": found 1, expected in (-1, 1)", ""},
       {kHomogeneous + "\"string preset\" \"Wholemlik\"",
        "unknown preset \"Wholemlik\"; did you mean \"Wholemilk\"?", "", kTolerated},
       {kHomogeneous + "\"string overlap\" \"adds\"", "unknown overlap \"adds\"; did you mean \"add\"?", ""},
       {kHomogeneous + "\"string overlap\" \"add\" \"integer priority\" 1",
        "needs \"string overlap\" \"priority\"", ""},
       {kHomogeneous + "\"float priority\" 1", "found type float, expected integer", ""},
       {kHomogeneous + "\"string phase\" \"raleigh\"",
        "unknown phase function \"raleigh\"; did you mean \"rayleigh\"?", ""},
       {kHomogeneous + "\"string phase\" \"henyeygreenstein\" \"float g\" [ .1 .2 ]",
        "\"g\": found 2 numbers, expected one for each \"henyeygreenstein\": 1", ""},
       {kHomogeneous + "\"string phase\" \"henyeygreenstein\" \"float g\" 1", "expected in (-1, 1)", ""},
       {kHomogeneous + "\"string phase\" [ \"rayleigh\" \"isotropic\" ] \"float phaseweight\" 1",
        "\"phaseweight\": found 1 numbers, expected one for each phase function: 2", ""},
       {kHomogeneous + "\"string phase\" [ \"rayleigh\" \"isotropic\" ] \"float phaseweight\" [ 0 0 ]",
        "all weights are 0", ""},
       {kHomogeneous + "\"string phase\" [ \"rayleigh\" \"isotropic\" ] \"float phaseweight\" [ -1 2 ]",
        "found a negative weight", ""},
       {kHomogeneous + "\"integer nx\" 1", "unknown parameter \"nx\"", "", kTolerated},
       {"\"string type\" \"heterogeneous\"",
        "parameter \"float density\" (or \"string filename\") is missing", "t.pbrt:2:1", kTolerated},
       {"\"string type\" \"heterogeneous\" \"integer nx\" 2 \"float density\" [ 1 1 1 ]",
        "found 3 values, expected nx*ny*nz = 2*1*1 = 2", "", kTolerated},
       {"\"string type\" \"heterogeneous\" \"integer nx\" 2 \"float density\" [ 1 -1 ]",
        "parameter \"density\" holds 1 negative value at voxel (1, 0, 0): -1; it counts as 0", "",
        kTolerated},
       {"\"string type\" \"heterogeneous\" \"integer nz\" 0 \"float density\" [ 1 ]",
        "found a grid of 1 x 1 x 0 samples (nx, ny, nz), expected at least 1 each; the medium is vacuum", "",
        kTolerated},
       {kGrid + "\"point p1\" [ 1 0 1 ]", "the box is flat: p0 and p1 agree in y", ""},
       {kGrid + "\"string border\" \"clmap\"", "unknown border \"clmap\"; did you mean \"clamp\"?", ""}},
      with);
}

TEST(ConstructMedium, TakesTheDefaultsOfAnUnknownPreset) {
  const Attempt a = attemptWorld(
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string preset\" \"Nectar\" MediumInterface "
      "\"m\" \"\" "
      "Material \"\" Shape \"sphere\"");
  ASSERT_TRUE(a.warns("unknown preset")) << a.messages();
  EXPECT_EQ(media(a), media(with(kHomogeneous)));
  const Attempt vacuum = attemptWorld(
      "MakeNamedMedium \"m\" \"string type\" \"cloud\" MediumInterface \"m\" \"\" Shape \"sphere\"");
  ASSERT_TRUE(vacuum.warns("unknown type \"cloud\"")) << vacuum.messages();
  EXPECT_EQ(mediumOf(vacuum), nullptr) << "an unknown medium is vacuum, as in PBRT-v3";
}

}  // namespace
}  // namespace pbrtmedia::test
