// SPDX-License-Identifier: BSD-2-Clause
#include "media/grid_medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/diagnostics.h"
#include "base/hash.h"
#include "media/homogeneous.h"
#include "support/grids.h"
#include "support/statistics.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

using test::constantGrid;
using test::gridOf;
using test::kMaxAbsZ;
using test::randomGrid;
using test::randomSegment;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20240611;
const Segment kAxis{{-1, .5f, .5f}, {1, 0, 0}, 0, kInfinity};

std::unique_ptr<Medium> gridMedium(GridField::Params grid, Rgb sigmaA, Rgb sigmaS,
                                   AnyEstimator estimator = {}, const Transform& worldFromMedium = {}) {
  GridMediumParams params;
  params.name = "smoke";
  params.sigmaA = sigmaA;
  params.sigmaS = sigmaS;
  params.estimator = estimator;
  params.grid = std::move(grid);
  return makeGridMedium(params, worldFromMedium);
}

/// The same constant density as one voxel and as many.
std::vector<std::unique_ptr<Medium>> constantMedia(float sigmaT) {
  std::vector<std::unique_ptr<Medium>> media;
  const Rgb a(.75f * sigmaT), s(.25f * sigmaT);
  media.push_back(gridMedium(constantGrid(1, GridBorder::Clamp), a, s));
  media.push_back(gridMedium(constantGrid(64, GridBorder::Clamp), a, s));
  return media;
}

RunningStats transmittances(const Medium& medium, const Segment& segment, int n, std::size_t channel = 0) {
  Rng rng(kSeed);
  RenderCounters counters;
  RunningStats values;
  for (int i = 0; i < n; ++i) values.add(medium.transmittance(segment, rng, counters)[channel]);
  EXPECT_EQ(counters.boundViolations, 0u);
  return values;
}

TEST(GridMedium, OfConstantDensityIsTheHomogeneousMedium) {
  for (const float sigmaT : {1e-3f, .1f, 1.0f, 5.0f, 50.0f, 1e3f, 1e6f}) {
    for (const auto& medium : constantMedia(sigmaT)) {
      const double truth = std::exp(-double{sigmaT});
      constexpr double kN = 40000;
      // A tight bound makes every walk a Bernoulli trial, whose variance is known.
      const double mean = transmittances(*medium, kAxis, static_cast<int>(kN)).mean();
      EXPECT_LT(std::abs(mean - truth) / std::sqrt(truth * (1 - truth) / kN + 1e-300), kMaxAbsZ)
          << medium->describe() << ", sigma_t " << sigmaT;

      Rng rng(kSeed);
      RenderCounters counters;
      std::vector<double> depths;
      for (int n = 0; n < 20000; ++n) {
        const FreeFlight flight = medium->sampleFreeFlight(kAxis, Rgb(1), rng, counters);
        ASSERT_EQ(flight.weight, Rgb(flight.collided ? .25f : 1.0f));
        if (flight.collided) depths.push_back((flight.t - 1) * sigmaT);
      }
      if (depths.size() < 100) continue;
      const auto ks =
          test::ksTest(depths, [&](double x) { return std::expm1(-x) / std::expm1(-double{sigmaT}); });
      EXPECT_GT(ks.pValue(), test::kMinPValue) << medium->describe() << ", sigma_t " << sigmaT << ": " << ks;
    }
  }
}

TEST(GridMedium, TakesAnotherPatternForEachEstimateOfASample) {
  // Of track-length, 0 or 1, the square is itself: two estimates from the same numbers would be one.
  GridMediumParams params;
  params.name = "smoke";
  params.sigmaA = Rgb(1);
  params.sigmaS = Rgb(0);
  params.estimator = TrackLength{};
  params.pattern = PatternKind::LatinHypercube;
  params.grid = constantGrid(8, GridBorder::Clamp);
  const auto medium = makeGridMedium(params, Transform());
  RunningStats products;
  for (std::uint64_t pixel = 0; pixel < 2000; ++pixel) {
    double product = 0;  // the mean over the samples of a pixel
    for (std::uint64_t sample = 0; sample < 16; ++sample) {
      Rng rng(hashCombine(kSeed, pixel, sample));
      RenderCounters counters;
      PixelSample pixelSample{pixel, sample, 16, 0};
      const PixelStream random(rng, pixelSample);
      const float first = medium->transmittance(kAxis, random, counters).r;
      product += double{first * medium->transmittance(kAxis, random, counters).r} / 16;
    }
    products.add(product);
  }
  const auto test = zTest(products, std::exp(-2.0), kSeed);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(GridMedium, FadesAtTheBorderByPbrtsRule) {
  for (const int n : {1, 2, 3, 8, 64}) {
    const double tau = 2 * (1 - .25 / n);
    const auto exact = gridMedium(constantGrid(n, GridBorder::Zero), Rgb(1), Rgb(1), RegularTracking{});
    const auto ratio = gridMedium(constantGrid(n, GridBorder::Zero), Rgb(1), Rgb(1), RatioTracking{});
    Rng rng(1);
    RenderCounters counters;
    EXPECT_NEAR(exact->transmittance(kAxis, rng, counters).r, std::exp(-tau), 1e-7) << n;
    const auto test = zTest(transmittances(*ratio, kAxis, 200000), std::exp(-tau), kSeed);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << n << ": " << test;
    RunningStats passed;
    for (int i = 0; i < 200000; ++i)
      passed.add(ratio->sampleFreeFlight(kAxis, Rgb(1), rng, counters).collided ? 0 : 1);
    const auto through = zTest(passed, std::exp(-tau), kSeed);
    EXPECT_LT(std::abs(through.z()), kMaxAbsZ) << n << ": " << through;
  }
}

TEST(GridMedium, MeansAgreeWithTheExactColumnOnRandomRays) {
  const auto grid = randomGrid(20, 24, 12, GridBorder::Zero, .5f, 12);
  const Transform place = Transform::translate({3, 0, -2}) * Transform::rotate(33, {1, 2, 0});
  const Rgb sigma(8);
  const auto exact = gridMedium(grid, Rgb(0), sigma, RegularTracking{}, place);
  const auto ratio = gridMedium(grid, Rgb(0), sigma, RatioTracking{}, place);
  Rng rng(kSeed);
  RenderCounters counters;
  for (int ray = 0; ray < 20; ++ray) {
    Segment segment = randomSegment(rng, 1);
    segment.o = place.point(segment.o);
    segment.d = 2.5f * place.vector(segment.d);  // t need not be a length in medium space
    const double truth = exact->transmittance(segment, rng, counters).r;
    RunningStats transmitted, passed;
    for (int n = 0; n < 20000; ++n) {
      transmitted.add(ratio->transmittance(segment, rng, counters).r);
      passed.add(ratio->sampleFreeFlight(segment, Rgb(1), rng, counters).collided ? 0 : 1);
    }
    for (const auto& test : {zTest(transmitted, truth, kSeed), zTest(passed, truth, kSeed)}) {
      EXPECT_TRUE(std::abs(test.z()) < kMaxAbsZ || std::abs(test.mean - truth) < 1e-6) << test;
    }
  }
  EXPECT_EQ(counters.boundViolations, 0u);
}

TEST(GridMedium, IsExactPerChannelWhenChromatic) {
  const Rgb sigmaS(0, .5f, 4), sigmaA(0, .5f, 6);
  const auto grid = constantGrid(4, GridBorder::Zero);
  const auto medium = gridMedium(grid, sigmaA, sigmaS),
             grey = gridMedium(grid, Rgb(0), Rgb(1), RegularTracking{});
  Rng rng(kSeed);
  RenderCounters counters;
  const double column = -std::log(double{grey->transmittance(kAxis, rng, counters).r});
  RunningStats transmitted[3], passed[3], scattered[3];
  for (int n = 0; n < 200000; ++n) {
    const Rgb t = medium->transmittance(kAxis, rng, counters);
    const FreeFlight flight = medium->sampleFreeFlight(kAxis, Rgb(1), rng, counters);
    for (std::size_t c = 0; c < 3; ++c) {
      transmitted[c].add(t[c]);
      passed[c].add(flight.collided ? 0 : flight.weight[c]);
      scattered[c].add(flight.collided ? flight.weight[c] : 0);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double sigmaT = double{sigmaA[c]} + double{sigmaS[c]}, t = std::exp(-sigmaT * column);
    const double albedo = sigmaT > 0 ? sigmaS[c] / sigmaT : 0;
    for (const auto& test : {zTest(transmitted[c], t, kSeed), zTest(passed[c], t, kSeed),
                             zTest(scattered[c], albedo * (1 - t), kSeed)}) {
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "channel " << c << ": " << test;
    }
  }
}

TEST(GridMedium, IsClearWhereEverySampleIsZero) {
  const auto medium = gridMedium(constantGrid(8, GridBorder::Zero, 0), Rgb(1), Rgb(1));
  EXPECT_TRUE(medium->bounds().isEmpty());
  Rng rng(1);
  RenderCounters counters;
  EXPECT_EQ(medium->transmittance(kAxis, rng, counters), Rgb(1));
  EXPECT_FALSE(medium->sampleFreeFlight(kAxis, Rgb(1), rng, counters).collided);
  EXPECT_EQ(counters.densityLookups, 0u);
}

TEST(GridMedium, SpendsNoLookupInEmptyCells) {
  const auto grid = gridOf(64, 64, 64, GridBorder::Zero,
                           [](int i, int j, int k) { return i == j && j == k ? 1.0f : 0.0f; });
  const auto medium = gridMedium(grid, Rgb(0), Rgb(1e4f));
  Rng rng(1);
  RenderCounters counters;
  const Segment beside{{-1, .25f, .75f}, {1, 0, 0}, 0, kInfinity};
  EXPECT_EQ(medium->transmittance(beside, rng, counters), Rgb(1));
  EXPECT_EQ(counters.densityLookups, 0u);
  const Segment across{{.25f, -1, .25f}, {0, 1, 0}, 0, kInfinity};
  for (int n = 0; n < 100; ++n) medium->transmittance(across, rng, counters);
  EXPECT_GT(counters.densityLookups, 0u);
}

TEST(GridMedium, HasBoundsThatHoldItsDensity) {
  const auto grid =
      gridOf(16, 16, 16, GridBorder::Zero, [](int i, int, int) { return i == 15 ? 1.0f : 0.0f; });
  const auto medium = gridMedium(grid, Rgb(1), Rgb(1), {}, Transform::translate({100, 0, 0}));
  const Bounds3f box = medium->bounds();
  EXPECT_TRUE(box.contains({101, 1, 1}));
  EXPECT_TRUE(box.contains({101 - 1.4f / 16, 0, 0}));
  EXPECT_FALSE(box.contains({100.5f, .5f, .5f}));
}

TEST(GridMedium, IsDefinedOnDegenerateSegments) {
  const auto medium = gridMedium(constantGrid(4, GridBorder::Clamp), Rgb(1), Rgb(1));
  Rng rng(1);
  RenderCounters counters;
  const auto clear = [&](const Segment& s) {
    EXPECT_EQ(medium->transmittance(s, rng, counters), Rgb(1));
    const FreeFlight flight = medium->sampleFreeFlight(s, Rgb(1), rng, counters);
    EXPECT_FALSE(flight.collided);
    EXPECT_EQ(flight.weight, Rgb(1));
  };
  clear({{.5f, .5f, .5f}, {1, 0, 0}, .1, .1});
  clear({{.5f, .5f, .5f}, {0, 0, 0}, 0, kInfinity});
  clear({{5, .5f, .5f}, {1, 0, 0}, 0, kInfinity});
  clear({{1e30f, 1e30f, 1e30f}, {1, 0, 0}, 0, kInfinity});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Segment& s : {Segment{{nan, 0, 0}, {1, 0, 0}, 0, 1}, Segment{{0, 0, 0}, {1, nan, 0}, 0, 1},
                           Segment{{0, 0, 0}, {1, 0, 0}, nan, 1}}) {
    EXPECT_TRUE(std::isnan(medium->transmittance(s, rng, counters).r));
    EXPECT_TRUE(std::isnan(medium->sampleFreeFlight(s, Rgb(1), rng, counters).weight.r));
  }
}

TEST(GridMedium, CollidesInsideTheSegment) {
  const auto medium = gridMedium(randomGrid(8, 8, 8, GridBorder::Zero, .2f, 3), Rgb(0), Rgb(1e5f));
  Rng rng(kSeed);
  RenderCounters counters;
  int collisions = 0;
  for (int n = 0; n < 20000; ++n) {
    Segment segment = randomSegment(rng, 2);
    segment.tMin = 2 * rng.uniformDouble();
    segment.tMax = segment.tMin + rng.uniformDouble();
    const FreeFlight flight = medium->sampleFreeFlight(segment, Rgb(1), rng, counters);
    if (!flight.collided) continue;
    ++collisions;
    ASSERT_TRUE(flight.t >= segment.tMin && flight.t <= segment.tMax);
  }
  EXPECT_GT(collisions, 1000);
  EXPECT_EQ(counters.boundViolations, 0u);
}

TEST(GridMedium, RefusesBadParameters) {
  const auto grid = constantGrid(2, GridBorder::Zero);
  EXPECT_THROW(gridMedium(grid, Rgb(-1), Rgb(1)), SceneError);
  EXPECT_THROW(gridMedium(grid, Rgb(1), Rgb(kInfinity)), SceneError);
  GridMediumParams params;
  params.name = "smoke";
  params.sigmaA = params.sigmaS = Rgb(1);
  params.grid = grid;
  params.phase = {{PhaseLobe::Kind::HenyeyGreenstein, -1, 1}};
  EXPECT_THROW(makeGridMedium(params, Transform()), SceneError);
}

TEST(GridMedium, DescribesItselfInOneLine) {
  GridMediumParams params;
  params.name = "smoke";
  params.sigmaA = params.sigmaS = Rgb(1);
  params.estimator = AnyEstimator();
  params.grid = constantGrid(8, GridBorder::Clamp);
  const auto medium = makeGridMedium(params, Transform());
  EXPECT_EQ(medium->typeName(), "heterogeneous");
  EXPECT_EQ(medium->name(), "smoke");
  const std::size_t bytes = 10 * 10 * 10 * sizeof(float) + 5 * 5 * 5 * sizeof(SuperVoxel);
  EXPECT_EQ(
      medium->describe(),
      "grid 8 x 8 x 8, super-voxels 3 x 3 x 3 (0 empty), estimator ratio, free flights weighted-delta, 1 "
      "channel, " +
          std::to_string(bytes) + " bytes");
}

}  // namespace
}  // namespace pbrtmedia
