// SPDX-License-Identifier: BSD-2-Clause
#include "fields/field_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/rng.h"
#include "fields/constant_field.h"
#include "fields/grid_field.h"
#include "support/grids.h"

namespace pbrtmedia {
namespace {

using test::constantGrid;
using test::gridOf;
using test::randomGrid;
using test::randomSegment;

/// The contract of a walk: starts at 0, joins without gap, ends at the length, moves strictly forward, and
/// bounds the density inside each interval. Answers the number of intervals.
template <class Line>
int checkWalk(const Line& line) {
  double reached = 0;
  int intervals = 0;
  line.walk([&](double sEnter, double sExit, const SuperVoxel& bound) {
    EXPECT_EQ(sEnter, reached);
    EXPECT_LT(sEnter, sExit);
    for (const double f : {.01, .5, .99}) {
      const float density = line.density(sEnter + f * (sExit - sEnter));
      EXPECT_LE(density, bound.upper);
      EXPECT_GE(density, bound.lower);
    }
    reached = sExit;
    ++intervals;
    return true;
  });
  EXPECT_EQ(reached, line.length());
  double piecesReached = 0;
  line.walkPieces([&](double sEnter, double sExit) {
    EXPECT_GE(sEnter, piecesReached);
    EXPECT_LT(sEnter, sExit);
    piecesReached = sExit;
    return true;
  });
  EXPECT_LE(piecesReached, line.length());
  return intervals;
}

class FieldLineWalk : public testing::Test {
 protected:
  GridField field{randomGrid(23, 17, 9, GridBorder::Zero, .6f, 8), Transform()};
  FieldBounds bounds = FieldBounds::proven(field.superVoxels(1));
  std::optional<FieldLine<GridField>> clip(const Segment& s) const {
    return FieldLine<GridField>::clip(field, bounds, s);
  }
};

TEST_F(FieldLineWalk, JoinsWithoutGapOnRandomLines) {
  Rng rng(1);
  int hits = 0;
  for (int n = 0; n < 100000 && !HasFailure(); ++n) {
    const auto line = clip(randomSegment(rng, 3 * rng.uniform()));
    if (!line) continue;
    ++hits;
    EXPECT_LE(checkWalk(*line), 12 + 9 + 5 + 3);
  }
  EXPECT_GT(hits, 90000);
}

TEST_F(FieldLineWalk, JoinsWithoutGapParallelToAxesAndOnCellPlanes) {
  Rng rng(2);
  for (int n = 0; n < 30000 && !HasFailure(); ++n) {
    const std::size_t axis = rng.uniformInt(3);
    Segment s{{}, {}, 0, kInfinity};
    for (std::size_t a = 0; a < 3; ++a) {
      // Lattice planes of the samples and of the super-voxels lie at (c - 1/2)/n of the box.
      const int count = a == 0 ? 23 : (a == 1 ? 17 : 9);
      s.o[a] = rng.uniform() < .5f
                   ? rng.uniform()
                   : (static_cast<float>(rng.uniformInt(static_cast<std::uint32_t>(count))) + .5f) /
                         static_cast<float>(count);
    }
    s.d[axis] = rng.uniform() < .5f ? 1.0f : -1.0f;
    if (rng.uniform() < .3f) s.d[(axis + 1) % 3] = rng.uniform() < .5f ? 1e-30f : -1e-42f;
    if (rng.uniform() < .5f) s.o[axis] -= 2 * s.d[axis];
    const auto line = clip(s);
    if (line) checkWalk(*line);
  }
}

TEST_F(FieldLineWalk, JoinsWithoutGapFromFarAway) {
  Rng rng(3);
  for (const float distance : {1e3f, 1e6f, 1e9f, 1e15f, 1e25f}) {
    for (int n = 0; n < 2000 && !HasFailure(); ++n) {
      const auto line = clip(randomSegment(rng, distance));
      if (!line) continue;
      ASSERT_LE(line->length(), 2.0);
      checkWalk(*line);
    }
  }
}

TEST_F(FieldLineWalk, JoinsWithoutGapAlongDiagonalsThroughCellCorners) {
  const GridField cube(randomGrid(16, 16, 16, GridBorder::Clamp, .3f, 9), Transform());
  const FieldBounds cells = FieldBounds::proven(cube.superVoxels(1));
  for (const float sx : {-1.0f, 1.0f}) {
    for (const float sy : {-1.0f, 1.0f}) {
      for (const float shift : {0.0f, .5f / 16, 1.0f / 16}) {
        const Segment s{{.5f - sx + shift, .5f - sy + shift, -.5f + shift}, {sx, sy, 1}, 0, kInfinity};
        const auto line = FieldLine<GridField>::clip(cube, cells, s);
        ASSERT_TRUE(line);
        checkWalk(*line);
      }
    }
  }
}

TEST_F(FieldLineWalk, StretchesBetweenBordersAreTheSameDensityUnderTheSameBound) {
  Rng rng(4);
  int stretches = 0;
  for (int n = 0; n < 3000 && !HasFailure(); ++n) {
    const auto line = clip(randomSegment(rng, 3 * rng.uniform()));
    if (!line) continue;
    line->walk([&](double sEnter, double sExit, const SuperVoxel& bound) {
      const FieldLine<GridField> part = line->stretch(sEnter, sExit);
      EXPECT_EQ(part.length(), sExit - sEnter);
      EXPECT_EQ(part.tEntry(), line->tEntry() + sEnter);
      EXPECT_EQ(part.hasProvenBounds(), line->hasProvenBounds());
      checkWalk(part);
      const double middle = part.length() / 2;
      EXPECT_NEAR(part.density(middle), line->density(sEnter + middle), 1e-5);
      // Rounding may leave slivers of neighbours at the ends.
      double own = 0;
      part.walk([&](double a, double b, const SuperVoxel& here) {
        if (here == bound) own += b - a;
        return true;
      });
      EXPECT_NEAR(own, part.length(), 1e-12) << stretches;
      return ++stretches > 0;
    });
  }
  EXPECT_GT(stretches, 9000);
}

TEST(FieldLine, EntersAndLeavesWhereTheBoxBeginsAndEnds) {
  const ConstantField field({}, Transform());
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels());
  const auto clip = [&](Point3f o, Vector3f d, double tMin, double tMax) {
    return FieldLine<ConstantField>::clip(field, bounds, {o, d, tMin, tMax});
  };
  const auto whole = clip({-1, .5f, .5f}, {1, 0, 0}, 0, kInfinity);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->tEntry(), 1);
  EXPECT_EQ(whole->length(), 1);
  const auto scaled = clip({-1, .5f, .5f}, {2, 0, 0}, 0, kInfinity);
  ASSERT_TRUE(scaled);
  EXPECT_EQ(scaled->tEntry(), .5);
  EXPECT_EQ(scaled->length(), .5);  // t is what counts, not distance
  const auto part = clip({-1, .5f, .5f}, {1, 0, 0}, 1.25, 1.5);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->tEntry(), 1.25);
  EXPECT_EQ(part->length(), .25);
  const auto inFace = clip({-1, 0, .5f}, {1, 0, 0}, 0, kInfinity);
  ASSERT_TRUE(inFace);
  EXPECT_EQ(inFace->length(), 1);
}

TEST(FieldLine, IsNothingWhereThereIsNoLength) {
  const ConstantField field({}, Transform());
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels());
  const auto misses = [&](Point3f o, Vector3f d, double tMin, double tMax) {
    return !FieldLine<ConstantField>::clip(field, bounds, {o, d, tMin, tMax});
  };
  EXPECT_TRUE(misses({-1, 2, .5f}, {1, 0, 0}, 0, kInfinity));
  EXPECT_TRUE(misses({-1, .5f, .5f}, {-1, 0, 0}, 0, kInfinity));
  EXPECT_TRUE(misses({.5f, .5f, .5f}, {1, 0, 0}, .25, .25));
  EXPECT_TRUE(misses({.5f, .5f, .5f}, {1, 0, 0}, .5, .25));
  EXPECT_TRUE(misses({.5f, .5f, .5f}, {0, 0, 0}, 0, kInfinity));
  EXPECT_TRUE(misses({-1, .5f, .5f}, {1, 0, 0}, 0, 1));
  const ConstantField clear({0.0f}, Transform());
  const FieldBounds none = FieldBounds::proven(clear.superVoxels());
  EXPECT_FALSE(FieldLine<ConstantField>::clip(clear, none, {{-1, .5f, .5f}, {1, 0, 0}, 0, 9}));
}

TEST(FieldLine, IsNothingOrStaysInsideWhereASegmentIsNotFinite) {
  const GridField field(randomGrid(6, 7, 8, GridBorder::Clamp, 0, 11),
                        Transform::rotate(30, {1, 2, 3}) * Transform::scale(2, 3, .5));
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels(1));
  constexpr float kBad[] = {
      std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 3e38f, -1e-42f, 0};
  constexpr double kBadT[] = {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e300, 0, .25};
  Rng rng(12);
  int lines = 0;
  for (int n = 0; n < 100000; ++n) {
    Segment s{{rng.uniform(), rng.uniform(), rng.uniform() / 4}, {}, 0, kInfinity};
    for (std::size_t a = 0; a < 3; ++a) {
      s.d[a] = rng.uniform() < .3f ? kBad[rng.uniformInt(6)] : 2 * rng.uniform() - 1;
      if (rng.uniform() < .1f) s.o[a] = kBad[rng.uniformInt(6)];
    }
    if (rng.uniform() < .2f) s.tMin = kBadT[rng.uniformInt(6)];
    if (rng.uniform() < .2f) s.tMax = kBadT[rng.uniformInt(6)];
    const auto line = FieldLine<GridField>::clip(field, bounds, s);
    if (!line) continue;
    ++lines;
    const double l = line->length();
    ASSERT_TRUE(l > 0 && std::isfinite(l));
    const double points[] = {0, l, std::nextafter(l, 0.0), l / 2, l / 3};
    float out[5];
    line->densities(points, out);
    for (const float density : out) ASSERT_TRUE(density >= 0 && density <= bounds.inForce().maximum());
  }
  EXPECT_GT(lines, 10000);
}

}  // namespace
}  // namespace pbrtmedia
