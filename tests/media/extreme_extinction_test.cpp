// SPDX-License-Identifier: BSD-2-Clause
// Media so dense that the bounds of super-voxels alone would cost 1e20 null collisions: every estimator and
// sampler ends, with the result of an opaque body.
#include <gtest/gtest.h>

#include "fields/perlin_density.h"
#include "media/grid_medium.h"
#include "media/procedural_medium.h"
#include "support/grids.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20261129;
constexpr float kExtreme = 1e20f, kLargest = 3e38f;
/// From x = -1 through both media.
const Segment kThrough{{-1, .52f, .48f}, {1, 0, 0}, 0, kInfinity};

/// What all parameters of field media have in common here.
void set(FieldMediumParams& params, Rgb sigmaT, const AnyEstimator& estimator, const AnySampler& sampler,
         bool scatters) {
  params.sigmaS = scatters ? sigmaT : Rgb(0);
  params.sigmaA = scatters ? Rgb(0) : sigmaT;
  params.estimator = estimator;
  params.sampler = sampler;
}

std::unique_ptr<Medium> noise(Rgb sigmaT, const AnyEstimator& estimator = {}, const AnySampler& sampler = {},
                              bool scatters = false) {
  ProceduralMediumParams params;
  params.name = "noise";
  set(params, sigmaT, estimator, sampler, scatters);
  params.field.function = std::make_shared<PerlinDensity>(PerlinDensity::Params{});
  params.field.cells = {6, 6, 6};
  return makeProceduralMedium(params, "perlin", Transform());
}

/// 0 up to x = 1/2, from there a ramp.
std::unique_ptr<Medium> ramp(Rgb sigmaT, const AnyEstimator& estimator = {}, const AnySampler& sampler = {},
                             bool scatters = false) {
  GridMediumParams params;
  params.name = "ramp";
  set(params, sigmaT, estimator, sampler, scatters);
  params.grid = test::gridOf(16, 1, 1, GridBorder::Clamp,
                             [](int i, int, int) { return i < 8 ? 0.0f : static_cast<float>(i - 7) / 8; });
  return makeGridMedium(params, Transform());
}

TEST(ExtremeExtinction, IsOpaqueToEveryEstimator) {
  Rng rng(kSeed);
  RenderCounters counters;
  for (const std::string_view name : estimatorNames()) {
    SCOPED_TRACE(name);
    const AnyEstimator estimator = *findEstimator(name);
    if (!std::holds_alternative<ExponentialLaw>(lawOf(estimator))) continue;  // long tails: not opaque
    for (const float sigma : {kExtreme, kLargest}) {
      EXPECT_EQ(ramp(Rgb(sigma), estimator)->transmittance(kThrough, rng, counters), Rgb(0));
    }
    if (traitsOf(estimator).needsPieces) continue;
    EXPECT_EQ(noise(Rgb(kExtreme), estimator)->transmittance(kThrough, rng, counters), Rgb(0));
    EXPECT_EQ(noise(Rgb(kExtreme, 0, 1e9f), estimator)->transmittance(kThrough, rng, counters), Rgb(0, 1, 0));
  }
  EXPECT_EQ(counters.boundViolations, 0u);
}

TEST(ExtremeExtinction, EndsFlightsWhereDensityBegins) {
  Rng rng(kSeed);
  RenderCounters counters;
  for (const std::string_view name : samplerNames()) {
    SCOPED_TRACE(name);
    const AnySampler sampler = *findSampler(name);
    if (traitsOf(sampler).bias != EstimatorTraits::Bias::Unbiased) continue;  // marches over the beginning
    const auto onRamp = ramp(Rgb(kExtreme), {}, sampler, true);
    // Half a voxel before the first positive sample interpolation begins: at (7 + 1/2) / 16 of the cube.
    for (int i = 0; i < 100; ++i) {
      const FreeFlight flight = onRamp->sampleFreeFlight(kThrough, Rgb(1), rng, counters);
      ASSERT_TRUE(flight.collided);
      EXPECT_NEAR(flight.t, 1 + 7.5 / 16, 1e-6);
    }
    if (traitsOf(sampler).needsPieces) continue;
    const auto inNoise = noise(Rgb(kExtreme), {}, sampler, true);
    const FreeFlight first = inNoise->sampleFreeFlight(kThrough, Rgb(1), rng, counters);
    ASSERT_TRUE(first.collided);
    for (int i = 0; i < 100; ++i) {
      const FreeFlight flight = inNoise->sampleFreeFlight(kThrough, Rgb(1), rng, counters);
      ASSERT_TRUE(flight.collided);
      EXPECT_NEAR(flight.t, first.t, 1e-6);
    }
  }
  EXPECT_EQ(counters.boundViolations, 0u);
  EXPECT_LT(counters.nullCollisions, 100000000u);
}

/// The depth where flights on the ramp end has a known mean: sigma_t s^2 / 2 is an exponential variate on a
/// density that rises like 2 s.
TEST(ExtremeExtinction, KeepsTheDistributionOfFlights) {
  Rng rng(kSeed);
  RenderCounters counters;
  const float sigma = 1e9f;
  const auto onRamp = ramp(Rgb(sigma), {}, {}, true);
  test::RunningStats depths;
  for (int i = 0; i < 20000; ++i) {
    const FreeFlight flight = onRamp->sampleFreeFlight(kThrough, Rgb(1), rng, counters);
    ASSERT_TRUE(flight.collided);
    const double s = flight.t - (1 + 7.5 / 16);
    depths.add(double{sigma} * s * s);  // density 1/8 per 1/16
  }
  const test::ZTest test = test::zTest(depths, 1.0, kSeed);
  EXPECT_LT(std::abs(test.z()), test::kMaxAbsZ) << test;
}

}  // namespace
}  // namespace pbrtmedia
