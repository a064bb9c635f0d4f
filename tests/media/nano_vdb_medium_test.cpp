// SPDX-License-Identifier: BSD-2-Clause
#include "media/nano_vdb_medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/diagnostics.h"
#include "fields/nano_vdb_samples.h"
#include "media/grid_medium.h"
#include "support/grids.h"
#include "support/statistics.h"
#include "support/temporary_folder.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

using test::Ijk;
using test::kMaxAbsZ;
using test::NanoVdbSample;
using test::zTest;

constexpr Rgb kSigmaA{.5f, .5f, .5f}, kSigmaS{1, 1, 1};

double waves(Ijk at) {
  return 0.5 + 0.25 * std::sin(0.7 * at[0]) + 0.25 * std::cos(1.1 * at[1] - 0.4 * at[2]);
}

std::unique_ptr<Medium> sparseMedium(const NanoVdbSample& sample, AnyEstimator estimator) {
  const TemporaryFolder folder;
  test::writeNanoVdb(folder.path() / "t.nvdb", {sample});
  NanoVdbMediumParams params;
  params.name = "smoke";
  params.sigmaA = kSigmaA;
  params.sigmaS = kSigmaS;
  params.estimator = estimator;
  params.field.file = folder.path() / "t.nvdb";
  return makeNanoVdbMedium(params, Transform());
}

/// The same samples with zeros around, as a dense grid.
std::unique_ptr<Medium> denseMedium(const NanoVdbSample& sample, AnyEstimator estimator) {
  GridMediumParams params;
  params.name = "smoke";
  params.sigmaA = kSigmaA;
  params.sigmaS = kSigmaS;
  params.estimator = estimator;
  const auto size = [&](std::size_t a) { return sample.max[a] - sample.min[a] + 3; };
  params.grid = test::gridOf(size(0), size(1), size(2), GridBorder::Zero, [&](int i, int j, int k) {
    const Ijk at{sample.min[0] + i - 1, sample.min[1] + j - 1, sample.min[2] + k - 1};
    bool inside = true;
    for (std::size_t a = 0; a < 3; ++a) inside = inside && at[a] >= sample.min[a] && at[a] <= sample.max[a];
    return inside ? static_cast<float>(sample.valueAt(at)) : 0.0f;
  });
  for (std::size_t a = 0; a < 3; ++a) {
    params.grid.p0[a] = static_cast<float>(sample.min[a]) - 1.5f;
    params.grid.p1[a] = static_cast<float>(sample.max[a]) + 1.5f;
  }
  return makeGridMedium(params, Transform());
}

Segment segmentThrough(Rng& rng, const NanoVdbSample& sample) {
  Point3f ends[2];
  for (Point3f& p : ends) {
    for (std::size_t a = 0; a < 3; ++a) {
      p[a] = static_cast<float>(sample.min[a]) - 2 +
             rng.uniform() * static_cast<float>(sample.max[a] - sample.min[a] + 4);
    }
  }
  const float length = std::sqrt(lengthSquared(ends[1] - ends[0]));
  return {ends[0], (ends[1] - ends[0]) / length, 0, length};
}

TEST(NanoVdbMedium, RegularTrackingIsThatOfTheDenseCopy) {
  const NanoVdbSample samples[] = {
      {.min = {-9, -4, 0}, .max = {3, 6, 11}, .valueAt = [](Ijk at) { return 0.1 * waves(at); }},
      {.min = {0, 0, 0}, .max = {15, 7, 7}, .valueAt = [](Ijk) { return 0.125; }}};
  for (const NanoVdbSample& sample : samples) {
    const auto sparse = sparseMedium(sample, RegularTracking{}),
               dense = denseMedium(sample, RegularTracking{});
    Rng rng(6);
    RenderCounters counters;
    for (int n = 0; n < 2000; ++n) {
      const Segment s = segmentThrough(rng, sample);
      const Rgb expected = dense->transmittance(s, rng, counters);
      ASSERT_NEAR(sparse->transmittance(s, rng, counters).r, expected.r, 1e-4) << s.o << s.d;
    }
  }
}

TEST(NanoVdbMedium, FreeFlightsAndRatioTrackingAgreeWithRegularTracking) {
  const NanoVdbSample sample{.min = {-9, -4, 0}, .max = {3, 6, 11}, .valueAt = waves};
  const auto exact = sparseMedium(sample, RegularTracking{}), ratio = sparseMedium(sample, RatioTracking{});
  Rng rng(9);
  RenderCounters counters;
  const Segment s{{-12, 1.3f, 4.4f}, normalize(Vector3f(1, .02f, .1f)), 2.5f, 4.25f};
  const double truth = exact->transmittance(s, rng, counters).r;
  ASSERT_GT(truth, 0.05);
  ASSERT_LT(truth, 0.9);
  test::RunningStats transmittance, passed;
  for (int n = 0; n < 100000; ++n) {
    transmittance.add(ratio->transmittance(s, rng, counters).r);
    const FreeFlight flight = ratio->sampleFreeFlight(s, Rgb(1), rng, counters);
    passed.add(flight.collided ? 0 : flight.weight.r);
  }
  EXPECT_EQ(counters.boundViolations, 0u);
  EXPECT_LT(std::abs(zTest(transmittance, truth).z()), kMaxAbsZ);
  EXPECT_LT(std::abs(zTest(passed, truth).z()), kMaxAbsZ);
}

TEST(NanoVdbMedium, ATileIsAConstantMediumInside) {
  const NanoVdbSample sample{.min = {0, 0, 0}, .max = {127, 127, 127}, .valueAt = [](Ijk) { return 0.5; }};
  const auto medium = sparseMedium(sample, RatioTracking{});
  Rng rng(3);
  RenderCounters counters;
  const Segment s{{10, 20, 30}, {0, 1, 0}, 0, 2};
  test::RunningStats values;
  for (int n = 0; n < 40000; ++n) values.add(medium->transmittance(s, rng, counters).r);
  EXPECT_LT(std::abs(zTest(values, std::exp(-1.5 * 0.5 * 2)).z()), kMaxAbsZ);
}

TEST(NanoVdbMedium, RaysThatMissItsBricksLookNothingUp) {
  const NanoVdbSample sample{.voxels = {{{0, 0, 0}, 1}, {{255, 255, 255}, 1}}};
  const auto medium = sparseMedium(sample, RatioTracking{});
  Rng rng(3);
  RenderCounters counters;
  EXPECT_EQ(medium->transmittance({{40, 100, -5}, {0, 0, 1}, 0, kInfinity}, rng, counters), Rgb(1.0f));
  EXPECT_EQ(counters.densityLookups, 0u);
}

}  // namespace
}  // namespace pbrtmedia
