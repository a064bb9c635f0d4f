// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/regular_tracking.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fields/constant_field.h"
#include "fields/field_line.h"
#include "fields/grid_field.h"
#include "support/function_line.h"
#include "support/grids.h"
#include "support/run_estimator.h"

namespace pbrtmedia {
namespace {

using test::runEstimator;

using test::constantGrid;
using test::gridOf;
using test::randomGrid;

template <class Field>
double columnAlong(const Field& field, const Segment& segment) {
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels());
  const auto line = FieldLine<Field>::clip(field, bounds, segment);
  LookupTally tally;
  return line ? RegularTracking::densityIntegral(*line, 1e300, tally) : 0;
}

const Segment kCentralAxis{{-1, .5f, .5f}, {1, 0, 0}, 0, kInfinity};

TEST(RegularTracking, FollowsBeerLambertOverTheWholeLadder) {
  const ConstantField constant({}, Transform());
  const GridField oneVoxel(constantGrid(1, GridBorder::Clamp), Transform());
  const GridField many(constantGrid(64, GridBorder::Clamp), Transform());
  const auto check = [](const auto& field, double tau) {
    using Field = std::decay_t<decltype(field)>;
    const FieldBounds bounds = FieldBounds::proven(field.superVoxels());
    const auto line = FieldLine<Field>::clip(field, bounds, kCentralAxis);
    Rng rng;
    const double t = runEstimator(RegularTracking(), *line, Channels<1>{tau}, rng).value[0];
    EXPECT_NEAR(-std::log(t), tau, 1e-12 * tau + 1e-15) << tau;
    // 1 - T keeps its digits where T is near 1.
    EXPECT_NEAR(1 - t, -std::expm1(-tau), 1e-10 * tau + 1e-15) << tau;
  };
  for (const double tau : {1e-6, 1e-3, .1, 1., 5., 20., 50., 87., 88., 104., 700.}) {
    check(constant, tau);
    check(oneVoxel, tau);
    check(many, tau);
  }
}

TEST(RegularTracking, IsExactlyZeroWhereNoDoubleIsLeft) {
  const GridField many(constantGrid(64, GridBorder::Clamp), Transform());
  const FieldBounds bounds = FieldBounds::proven(many.superVoxels());
  const auto line = FieldLine<GridField>::clip(many, bounds, kCentralAxis);
  Rng rng;
  for (const double tau : {1e3, 1e6, 1e30}) {
    const auto estimate = runEstimator(RegularTracking(), *line, Channels<1>{tau}, rng);
    EXPECT_EQ(estimate.value[0], 0.0);
    EXPECT_LE(estimate.tally.lookups, 2u * 65u);
  }
  // A clear channel keeps the walk going.
  const auto estimate = runEstimator(RegularTracking(), *line, Channels<3>{0, 1, 1e6}, rng);
  EXPECT_EQ(estimate.value[0], 1.0);
  EXPECT_NEAR(estimate.value[1], std::exp(-1.0), 1e-12);
  EXPECT_EQ(estimate.value[2], 0.0);
}

TEST(RegularTracking, LosesAnEighthOfAVoxelAtEachEndUnderTheZeroBorder) {
  for (const int n : {1, 2, 3, 8, 64}) {
    const GridField field(constantGrid(n, GridBorder::Zero), Transform());
    EXPECT_NEAR(columnAlong(field, kCentralAxis), 1 - .25 / n, 1e-7) << n;
  }
}

TEST(RegularTracking, KnowsTheIntegralsOfOneHotCorner) {
  const GridField field(
      gridOf(2, 2, 2, GridBorder::Clamp, [](int i, int j, int k) { return i + j + k == 0 ? 1.0f : 0.0f; }),
      Transform::scale(2, 2, 2));  // the cell between the eight centres is [1/2, 3/2]^3
  const auto along = [&](Vector3f d) {
    return columnAlong(field, {{.5f, .5f, .5f}, d / length(d), 0, length(d)});
  };
  EXPECT_NEAR(along({1, 0, 0}), 1. / 2, 1e-7);
  EXPECT_NEAR(along({0, 1, 1}), std::sqrt(2.) / 3, 1e-7);
  EXPECT_NEAR(along({1, 1, 1}), std::sqrt(3.) / 4, 1e-7);
  // Diagonals of the cell that miss the corner: u (1 - u)^2 and the like.
  EXPECT_NEAR(columnAlong(field, {{1.5f, .5f, .5f}, {-1, 1, 1}, 0, 1}), 1. / 12, 1e-7);
  EXPECT_NEAR(columnAlong(field, {{1.5f, .5f, .5f}, {-1, 1, 0}, 0, 1}), 1. / 6, 1e-7);
}

TEST(RegularTracking, AgreesWithBruteForceOnRandomGrids) {
  const GridField field(randomGrid(9, 7, 8, GridBorder::Zero, .3f, 4), Transform::rotate(40, {1, 1, 0}));
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels(1));
  Rng rng(5);
  for (int n = 0; n < 30; ++n) {
    const Segment ray = test::randomSegment(rng, 2);
    const auto line = FieldLine<GridField>::clip(field, bounds, ray);
    if (!line) continue;
    LookupTally tally;
    const double exact = RegularTracking::densityIntegral(*line, 1e300, tally);
    const double brute = test::simpson([&](double s) { return double{line->density(s)}; }, 0, line->length());
    EXPECT_NEAR(exact, brute, 1e-6 * line->length());
    // Negative control: two points for the whole line are not enough.
    const double half = line->length() / 2, offset = half / std::sqrt(3.0);
    const double twoPoints = half * (line->density(half - offset) + line->density(half + offset));
    if (brute > 1e-2) {
      EXPECT_GT(std::abs(twoPoints - brute), 1e-6 * line->length());
    }
  }
}

TEST(RegularTracking, AddsUpOverASplit) {
  const GridField field(randomGrid(16, 16, 16, GridBorder::Clamp, .3f, 6), Transform());
  Rng rng(7);
  for (int n = 0; n < 100; ++n) {
    Segment ray = test::randomSegment(rng, 1);
    const double whole = columnAlong(field, ray), at = 2 * rng.uniformDouble();
    Segment first = ray, second = ray;
    first.tMax = second.tMin = at;
    EXPECT_NEAR(columnAlong(field, first) + columnAlong(field, second), whole, 1e-6);
  }
}

}  // namespace
}  // namespace pbrtmedia
