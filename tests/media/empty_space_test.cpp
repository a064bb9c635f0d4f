// SPDX-License-Identifier: BSD-2-Clause
// What empty space costs: look-ups, counted.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "base/statistics.h"
#include "media/grid_medium.h"
#include "support/grids.h"

namespace pbrtmedia {
namespace {

using test::gridOf;
using test::randomSegment;

std::unique_ptr<Medium> smoke(GridField::Params grid, float sigmaT, WantedCells cells = {}) {
  GridMediumParams params;
  params.grid = std::move(grid);
  params.sigmaA = Rgb(sigmaT / 2);
  params.sigmaS = Rgb(sigmaT / 2);
  params.bounds.cells = cells;
  return makeGridMedium(params, Transform());
}

/// Look-ups of one transmittance and one free flight along each of `rays` random lines.
std::uint64_t lookups(const Medium& medium, int rays, std::uint64_t seed) {
  Rng lines(seed), rng(seed + 1);
  RenderCounters counters;
  for (int i = 0; i < rays; ++i) {
    const Segment segment = randomSegment(lines, 2);
    medium.transmittance(segment, rng, counters);
    medium.sampleFreeFlight(segment, Rgb(1), rng, counters);
  }
  return counters.densityLookups;
}

/// Whether the line comes within `reach` of the point.
bool passes(const Segment& segment, Point3f point, double reach) {
  const Vec3d o(segment.o), d(segment.d), away = Vec3d(point) - o;
  const Vec3d offset = away - (dot(away, d) / dot(d, d)) * d;
  return dot(offset, offset) < reach * reach;
}

TEST(OneHotVoxel, CostsNothingWhereRaysMissIt) {
  constexpr int n = 256, hot = 100;
  const auto medium =
      smoke(gridOf(n, n, n, GridBorder::Zero,
                   [](int i, int j, int k) { return i == hot && j == hot && k == hot ? 1e4f : 0.0f; }),
            10);
  // Its interpolated density lives within one voxel of it, in super-voxels of 4^3 samples.
  const float where = (hot + .5f) / n;
  const double reach = 5 * std::sqrt(3.0) / n;
  Rng lines(3), rng(4);
  RenderCounters missed, met;
  int misses = 0;
  for (int i = 0; i < 20000; ++i) {
    const Segment segment = randomSegment(lines, 2);
    const bool meets = passes(segment, Point3f(where, where, where), reach);
    misses += !meets;
    medium->transmittance(segment, rng, meets ? met : missed);
    medium->sampleFreeFlight(segment, Rgb(1), rng, meets ? met : missed);
  }
  EXPECT_GT(misses, 15000);
  EXPECT_EQ(missed.densityLookups, 0u) << "an empty grid needs none";
  EXPECT_EQ(missed.nullCollisions, 0u);
  // The test can see look-ups: a line through the voxel needs them.
  Rng through(5);
  for (int i = 0; i < 100; ++i) {
    const Segment line{Point3f(where - 1, where, where), Vector3f(1, 0, 0), 0, kInfinity};
    medium->transmittance(line, through, met);
  }
  EXPECT_GT(met.densityLookups, 100u);
}

TEST(MostlyEmptyCloud, NeedsATenthOfTheLookUpsOfASingleBound) {
  constexpr int n = 128;
  int empty = 0;
  const auto cloud = [&] {
    empty = 0;
    return gridOf(n, n, n, GridBorder::Zero, [&](int i, int j, int k) {
      const auto from = [=](int x) { return (x + .5) / n - .5; };
      const double r = std::sqrt(from(i) * from(i) + from(j) * from(j) + from(k) * from(k)) / .228;
      // A soft ball with a dense core, as clouds have.
      const double density = r < 1 ? std::pow(1 - r * r, 3.0) : 0;
      empty += !(density > 0);
      return static_cast<float>(density);
    });
  };
  constexpr float sigmaT = 100;
  const auto local = smoke(cloud(), sigmaT);
  ASSERT_NEAR(empty / std::pow(n, 3.0), 0.95, 0.002);
  const auto single = smoke(cloud(), sigmaT, std::array{1, 1, 1});
  const std::uint64_t few = lookups(*local, 4000, 9), many = lookups(*single, 4000, 9);
  EXPECT_GT(few, 1000u);
  EXPECT_GE(many, 10 * few);
}

}  // namespace
}  // namespace pbrtmedia
