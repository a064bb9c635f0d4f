// SPDX-License-Identifier: BSD-2-Clause
#include "world/media_stretch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/hash.h"
#include "media/grid_medium.h"
#include "media/homogeneous.h"
#include "support/function_line.h"
#include "support/grids.h"
#include "support/statistics.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20261130;
constexpr float kScattering = 1.2f;

/// Smoke in the unit cube that only absorbs.
std::unique_ptr<Medium> absorber(std::string_view estimator, PatternKind pattern) {
  GridMediumParams params;
  params.name = "smoke";
  params.sigmaA = Rgb(2);
  params.sigmaS = Rgb(0);
  params.estimator = findEstimator(estimator);
  params.pattern = pattern;
  params.grid = test::gridOf(4, 4, 4, GridBorder::Clamp, [](int i, int j, int k) {
    return (7 * i + 3 * j + 5 * k) % 4 == 0 ? 2.0f : 0.2f;
  });
  return makeGridMedium(params, Transform());
}

/// The mean weight of collisions in fog that lies in smoke: of the smoke, what it lets through up to them.
TEST(MediaStretch, WeighsCollisionsByWhatOtherMediaLetThrough) {
  const HomogeneousMedium fog(HomogeneousMedium::Params{.name = "fog",
                                                        .sigmaA = Rgb(0),
                                                        .sigmaS = Rgb(kScattering),
                                                        .phase = {PhaseLobe{}},
                                                        .overlap = {OverlapRule::Mode::Add, 0}});
  const Ray ray{.o = {0, .3f, .4f}, .d = {1, 0, 0}};
  RenderCounters counters;
  Rng unused(1);
  const auto exact = absorber("regular", PatternKind::Independent);
  const double truth = test::simpson(
      [&](double t) {
        const double smoke = exact->transmittance({ray.o, ray.d, 0, t}, unused, counters).g;
        return kScattering * std::exp(-kScattering * t) * smoke;
      },
      0, 1, 500);

  for (const PatternKind pattern :
       {PatternKind::Independent, PatternKind::LatinHypercube, PatternKind::Hammersley}) {
    const auto smoke = absorber("ratio", pattern);
    MediumState state(PlacedMedium{smoke.get()});
    state.enter({&fog});
    ASSERT_EQ(state.activeCount(), 2u);
    const MediaStretch stretch(state, ray, 0, 1);
    constexpr std::uint64_t kPixels = 20000, kSamples = 16;
    test::RunningStats means;  // of pixels, whose samples share a pattern
    for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel) {
      double sum = 0;
      for (std::uint64_t s = 0; s < kSamples; ++s) {
        Rng rng(hashCombine(kSeed, pixel, s));
        PixelSample sample{hashCombine(kSeed, pixel), s, kSamples, 0};
        const MediumFlight flight = stretch.sampleFreeFlight(Rgb(1), PixelStream(rng, sample), counters);
        if (flight.collided) sum += flight.weight.g;
      }
      means.add(sum / kSamples);
    }
    const auto test = test::zTest(means, truth, kSeed);
    EXPECT_LT(std::abs(test.z()), test::kMaxAbsZ)
        << kPatternNames[static_cast<std::size_t>(pattern)] << ": " << test;
    EXPECT_TRUE(test.sees(.01)) << test;
  }
}

/// Two media in one another: the noise that each tells makes that of both.
TEST(MediaStretch, PairsOfMediaMultiplyAsComplexNumbers) {
  const HomogeneousMedium fog(HomogeneousMedium::Params{.name = "fog",
                                                        .sigmaA = Rgb(0),
                                                        .sigmaS = Rgb(kScattering),
                                                        .phase = {PhaseLobe{}},
                                                        .overlap = {OverlapRule::Mode::Add, 0}});
  const Ray ray{.o = {0, .3f, .4f}, .d = {1, .1f, 0}};
  RenderCounters counters;
  for (const auto& [estimator, tells] : {std::pair("two-comb-umvu", true), std::pair("ratio", false)}) {
    const auto smoke = absorber(estimator, PatternKind::Independent);
    MediumState state(PlacedMedium{smoke.get()});
    Rng alone(kSeed), paired(kSeed), together(kSeed);
    RenderCounters ofOne, ofPair;
    const Rgb value = MediaStretch(state, ray, 0, 1).transmittance(alone, ofOne);
    const PairedTransmittance one = MediaStretch(state, ray, 0, 1).pairedTransmittance(paired, ofPair);
    EXPECT_EQ(one.value, value) << estimator;
    EXPECT_EQ(ofPair.densityLookups, ofOne.densityLookups) << estimator;
    EXPECT_EQ(!one.spread.isBlack(), tells) << estimator;
    state.enter({&fog});
    const PairedTransmittance both = MediaStretch(state, ray, 0, 1).pairedTransmittance(together, counters);
    const float through = std::exp(-kScattering);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(both.value[c], through * one.value[c], 1e-6) << estimator;
      EXPECT_NEAR(both.spread[c], through * one.spread[c], 1e-6) << estimator;
    }
  }
  PairedTransmittance product{Rgb(.5f), Rgb(.25f)};
  product *= {Rgb(.5f), Rgb(-.5f)};
  EXPECT_EQ(product.value, Rgb(.375f));
  EXPECT_EQ(product.spread, Rgb(-.125f));
}

}  // namespace
}  // namespace pbrtmedia
