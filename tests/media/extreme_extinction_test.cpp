// SPDX-License-Identifier: BSD-2-Clause
// Media so dense that the bounds of super-voxels alone would cost 1e20 null collisions: every estimator and
// sampler ends, with the result of an opaque body.
#include <gtest/gtest.h>

#include <array>

#include "fields/exploration.h"
#include "fields/learned_bounds.h"
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
void set(FieldMediumParams& params, Rgb sigmaT, const AnyEstimator& estimator, const AnyFlight& sampler,
         bool scatters) {
  params.sigmaS = scatters ? sigmaT : Rgb(0);
  params.sigmaA = scatters ? Rgb(0) : sigmaT;
  params.estimator = estimator;
  params.flights = sampler;
}

std::unique_ptr<Medium> noise(Rgb sigmaT, const AnyEstimator& estimator = {}, const AnyFlight& sampler = {},
                              bool scatters = false) {
  ProceduralMediumParams params;
  params.name = "noise";
  set(params, sigmaT, estimator, sampler, scatters);
  params.field.function = std::make_shared<PerlinDensity>(PerlinDensity::Params{});
  params.field.cells = {6, 6, 6};
  return makeProceduralMedium(params, "perlin", Transform());
}

/// 0 up to x = 1/2, from there a ramp.
std::unique_ptr<Medium> ramp(Rgb sigmaT, const AnyEstimator& estimator = {}, const AnyFlight& sampler = {},
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
  for (const std::string_view name : flightNames()) {
    SCOPED_TRACE(name);
    const AnyFlight sampler = *findFlight(name);
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

/// 1 behind x = 0.55 and 0 before, about which nothing is known: a super-voxel holds both.
class Blocks final : public DensityFunction {
 public:
  float at(Vec3d p) const override { return p.x > 0.55 ? 1 : 0; }
  std::optional<Interval> range(const Bounds3d&) const override { return std::nullopt; }
  std::string describe() const override { return "blocks"; }
};

/// Bounds given, or learned and explored.
std::unique_ptr<Medium> blocks(float sigma, BoundsParams::Source source, bool scatters,
                               const AnyEstimator& estimator = {}) {
  ProceduralMediumParams params;
  params.name = "blocks";
  params.sigmaS = Rgb(scatters ? sigma : 0);
  params.sigmaA = Rgb(scatters ? 0 : sigma);
  params.estimator = estimator;
  params.field.function = std::make_shared<Blocks>();
  params.field.cells = {3, 3, 3};
  params.bounds.source = source;
  params.bounds.majorant = sigma;
  params.bounds.epsilon = 1e-3f * sigma;
  auto medium = makeProceduralMedium(params, "procedural", Transform());
  if (LearnedBounds* const learned = medium->learnedBounds()) {
    RenderCounters counters;
    const Exploration plan = planExploration(learned->inForce().shape(), 4, 27 * 4 * 16);
    medium->exploreBounds(plan, 0, plan.blockCount(), kSeed, counters);
    learned->publish();
  }
  return medium;
}

constexpr std::array kUnproven = {BoundsParams::Source::Constant, BoundsParams::Source::Progressive};

TEST(ExtremeExtinction, EndsUnderUnprovenBounds) {
  Rng rng(kSeed);
  RenderCounters counters;
  for (const auto source : kUnproven) {
    for (const float sigma : {kExtreme, 1e30f}) {
      const auto absorbing = blocks(sigma, source, false), scattering = blocks(sigma, source, true);
      for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(absorbing->transmittance(kThrough, rng, counters), Rgb(0));
        // Up to where density begins nothing is lost.
        const Segment before{kThrough.o, kThrough.d, 0, 1.55};
        EXPECT_EQ(absorbing->transmittance(before, rng, counters), Rgb(1));
        EXPECT_FALSE(scattering->sampleFreeFlight(before, Rgb(1), rng, counters).collided);
        const FreeFlight flight = scattering->sampleFreeFlight(kThrough, Rgb(1), rng, counters);
        ASSERT_TRUE(flight.collided);
        EXPECT_NEAR(flight.t, 1.55, 1e-3);
        EXPECT_EQ(flight.weight, Rgb(1));
      }
      EXPECT_NE(absorbing->complaint().find("instead of"), std::string::npos) << absorbing->complaint();
    }
  }
  EXPECT_EQ(counters.boundViolations, 0u);
}

TEST(ExtremeExtinction, OfNextToNothingIsNothingUnderUnprovenBounds) {
  Rng rng(kSeed);
  RenderCounters counters;
  constexpr float kTiny = 1e-30f;
  for (const auto source : kUnproven) {
    for (const std::string_view name : estimatorNames()) {
      SCOPED_TRACE(name);
      const AnyEstimator estimator = *findEstimator(name);
      if (traitsOf(estimator).needsPieces) continue;
      const auto absorbing = blocks(kTiny, source, false, estimator);
      test::RunningStats through;
      for (int i = 0; i < 4096; ++i) {
        const Rgb value = absorbing->transmittance(kThrough, rng, counters);
        ASSERT_TRUE(std::isfinite(value.r));
        through.add(value.r);
      }
      // Some have noise even here.
      if (traitsOf(estimator).bias != EstimatorTraits::Bias::Unbiased) continue;
      EXPECT_NEAR(through.mean(), 1, test::kMaxAbsZ * through.standardError() + 1e-6);
    }
    EXPECT_EQ(blocks(kTiny, source, false)->transmittance(kThrough, rng, counters), Rgb(1));
    const auto scattering = blocks(kTiny, source, true);
    EXPECT_FALSE(scattering->sampleFreeFlight(kThrough, Rgb(1), rng, counters).collided);
    EXPECT_EQ(scattering->complaint(), "");
  }
  EXPECT_EQ(counters.boundViolations, 0u);
}

TEST(ExtremeExtinction, IsTrackedAsGivenWhereItCanBe) {
  Rng rng(kSeed);
  RenderCounters counters;
  const float sigma = 1e4f;
  for (const auto source : kUnproven) {
    const auto scattering = blocks(sigma, source, true);
    EXPECT_EQ(scattering->complaint(), "");
    test::RunningStats depths;
    for (int i = 0; i < 300; ++i) {
      const FreeFlight flight = scattering->sampleFreeFlight(kThrough, Rgb(1), rng, counters);
      ASSERT_TRUE(flight.collided);
      depths.add(double{sigma} * (flight.t - 1.55));
    }
    const test::ZTest test = test::zTest(depths, 1.0, kSeed);
    EXPECT_LT(std::abs(test.z()), test::kMaxAbsZ) << test;
  }
}

}  // namespace
}  // namespace pbrtmedia
