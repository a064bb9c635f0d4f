// SPDX-License-Identifier: BSD-2-Clause
#include "media/presets.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>

#include "media/homogeneous.h"

namespace pbrtmedia {
namespace {

TEST(Presets, AreTheFortySevenMeasuredMedia) {
  EXPECT_EQ(mediumPresets().size(), 47u);
  std::set<std::string_view> names;
  for (const MediumPreset& preset : mediumPresets()) {
    names.insert(preset.name);
    EXPECT_TRUE(preset.sigmaPrimeS.min() >= 0 && preset.sigmaPrimeS.max() < 25) << preset.name;
    EXPECT_TRUE(preset.sigmaA.min() >= 0 && preset.sigmaA.max() < 62) << preset.name;
    ASSERT_TRUE(findPreset(preset.name));
    EXPECT_EQ(findPreset(preset.name)->sigmaA, preset.sigmaA);
  }
  EXPECT_EQ(names.size(), 47u);
}

TEST(Presets, HoldThePublishedNumbers) {
  const auto milk = findPreset("Wholemilk"), skin = findPreset("Skin1"), ketchup = findPreset("Ketchup");
  ASSERT_TRUE(milk && skin && ketchup);
  EXPECT_EQ(milk->sigmaPrimeS, Rgb(2.55f, 3.21f, 3.77f));
  EXPECT_EQ(milk->sigmaA, Rgb(.0011f, .0024f, .014f));
  EXPECT_EQ(skin->sigmaPrimeS, Rgb(.74f, .88f, 1.01f));
  EXPECT_EQ(skin->sigmaA, Rgb(.032f, .17f, .48f));
  EXPECT_EQ(ketchup->sigmaPrimeS, Rgb(.18f, .07f, .03f));
  EXPECT_EQ(ketchup->sigmaA, Rgb(.061f, .97f, 1.45f));
  // The defaults of a medium are whole milk's.
  EXPECT_EQ(HomogeneousMedium::Params().sigmaS, milk->sigmaPrimeS);
  EXPECT_EQ(HomogeneousMedium::Params().sigmaA, milk->sigmaA);
}

TEST(Presets, ReduceTheMeasuredScatteringByItsMeanCosine) {
  // Scattering in 1/mm and mean cosine as measured; reduced scattering is scattering * (1 - cosine).
  struct Measured {
    std::string_view name;
    Rgb sigmaS, meanCosine;
  };
  const Measured measured[] = {
      {"Lowfat Milk", {13.1157f, 15.4445f, 17.9572f}, {.932f, .902f, .859f}},
      {"Espresso", {7.78262f, 8.1305f, 8.53875f}, {.907f, .896f, .88f}},
      {"Regular Soy Milk", {4.66325f, 5.20183f, 8.74575f}, {.873f, .858f, .832f}},
      {"Gatorade", {.03668f, .04488f, .05742f}, {.933f, .933f, .935f}},
      {"White Grapefruit Juice", {.50499f, .52742f, .75282f}, {.548f, .545f, .565f}},
      {"Head & Shoulders Shampoo", {.26747f, .27696f, .29574f}, {.911f, .896f, .884f}},
      {"Cappuccino Powder", {12.2094f, 16.4659f, 29.2727f}, {.849f, .843f, .926f}},
      {"Pacific Ocean Surface Water", {.0018f, .00183f, .00228f}, {.902f, .825f, .914f}},
  };
  for (const Measured& m : measured) {
    const auto preset = findPreset(m.name);
    ASSERT_TRUE(preset) << m.name;
    for (std::size_t c = 0; c < 3; ++c) {
      const float reduced = m.sigmaS[c] * (1 - m.meanCosine[c]);
      EXPECT_NEAR(preset->sigmaPrimeS[c], reduced, .01f * reduced) << m.name;
    }
  }
}

TEST(Presets, AddUpToWhatTheTablesAddUpTo) {
  // Logarithms, so that the smallest number counts as much as the largest: one that is mistyped by a per cent
  // is seen.
  std::array<double, 3> scattering{}, absorption{};
  for (const MediumPreset& preset : mediumPresets()) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (preset.sigmaPrimeS[c] > 0) scattering[c] += std::log(double{preset.sigmaPrimeS[c]});
      if (preset.sigmaA[c] > 0) absorption[c] += std::log(double{preset.sigmaA[c]});
    }
  }
  constexpr std::array<double, 3> kScattering{-190.0255, -163.3856, -133.8468},
      kAbsorption{-179.5756, -139.6077, -105.3022};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(scattering[c], kScattering[c], 1e-3) << c;
    EXPECT_NEAR(absorption[c], kAbsorption[c], 1e-3) << c;
  }
}

TEST(Presets, AreCaseSensitive) {
  EXPECT_FALSE(findPreset("wholemilk"));
  EXPECT_FALSE(findPreset(""));
  EXPECT_FALSE(findPreset("Whole Milk"));
}

}  // namespace
}  // namespace pbrtmedia
