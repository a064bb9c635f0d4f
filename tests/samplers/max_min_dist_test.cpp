// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <limits>

#include "samplers/all_samplers.h"
#include "samplers/lattice.h"

namespace pbrtmedia {
namespace {

using namespace test;

double torusMinimum(const std::vector<Point2f>& points) {
  const auto wrap = [](double d) { return std::min(std::abs(d), 1 - std::abs(d)); };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      least = std::min(least, std::hypot(wrap(double{points[i].x} - points[k].x),
                                         wrap(double{points[i].y} - points[k].y)));
  }
  return least;
}

TEST(Lattice, MinimumDistanceMatchesBruteForce) {
  for (const std::uint32_t n : {2u, 8u, 16u, 64u}) {
    for (std::uint32_t m = 1; m < n; m += 2) {
      std::vector<Point2f> points;
      for (std::uint32_t j = 0; j < n; ++j)
        points.push_back({static_cast<float>(j) / static_cast<float>(n),
                          static_cast<float>(j * m % n) / static_cast<float>(n)});
      EXPECT_NEAR(std::sqrt(static_cast<double>(latticeMinimumSquared(n, m))) / n, torusMinimum(points),
                  1e-6);
    }
  }
}

TEST(Lattice, BestMultiplierOfSixteenPointsHasADistanceOfRootTen) {
  EXPECT_EQ(latticeMinimumSquared(16, maxMinDistMultiplier(16)),
            10u);  // (3, 1); rows and columns stay distinct
  EXPECT_EQ(maxMinDistMultiplier(1), 1u);
  EXPECT_EQ(maxMinDistMultiplier(2), 1u);
}

TEST(Lattice, BestMultiplierComesNearTheHexagonalBound) {
  for (std::uint32_t n = 16; n <= MaxMinDistSampler::kMaxPoints; n *= 2) {
    const std::uint32_t m = maxMinDistMultiplier(n);
    EXPECT_EQ(m % 2, 1u);
    const double squared = static_cast<double>(latticeMinimumSquared(n, m)) / n, bound = 2 / std::sqrt(3.0);
    EXPECT_LE(squared, bound);  // of the hexagonal lattice: no arrangement of points does better
    EXPECT_GE(squared, (n < 128 ? 0.54 : 0.85) * bound) << n;  // few odd multipliers to choose from at first
  }
}

TEST(MaxMinDist, FilmPointsAreFartherApartThanThoseOfTheZeroTwoSequence) {
  for (int n = 16; n <= 1024; n *= 4) {
    MaxMinDistSampler s({.pixelSamples = n});
    ZeroTwoSampler z({.pixelSamples = n});
    for (int p = 0; p < 5; ++p) {
      const double mine = torusMinimum(slotPoints(s, {p, 2}, 0, 0, n));
      EXPECT_GT(mine, torusMinimum(slotPoints(z, {p, 2}, 0, 0, n))) << n;
      EXPECT_GT(mine, 0.79 / std::sqrt(n)) << n;
    }
  }
}

TEST(MaxMinDist, FilmPointsFillRowsAndColumnsAlsoInPrefixesAndLaterRounds) {
  MaxMinDistSampler s({.pixelSamples = 64});
  for (int p = 0; p < 20; ++p) {
    for (int n = 1; n <= 64; n *= 2) {
      for (const std::int64_t first : {0, 64}) {
        // Shifted lattices: columns of width 1/n, counted from the first point.
        std::vector<Point2f> points = slotPoints(s, {p, 2}, 0, first, n);
        const Point2f origin = points.front();
        for (Point2f& q : points)
          q = {static_cast<float>(std::fmod(double{q.x} - origin.x + 1 + 0.5 / n, 1)),
               static_cast<float>(std::fmod(double{q.y} - origin.y + 1 + 0.5 / n, 1))};
        EXPECT_TRUE(oneInEachCell(points, n, 1)) << n;
        EXPECT_TRUE(oneInEachCell(points, 1, n)) << n;
      }
    }
  }
}

TEST(MaxMinDist, OtherSlotsAreNets) {
  MaxMinDistSampler s({.pixelSamples = 64});
  EXPECT_TRUE(isNet(slotPoints(s, {1, 2}, 1, 0, 64)));
  EXPECT_FALSE(isNet(slotPoints(s, {1, 2}, 4, 0, 64)));  // past `dimensions`
}

TEST(MaxMinDist, TakesMoreSamplesThanItsLatticeHasPoints) {
  MaxMinDistSampler s({.pixelSamples = 2 * MaxMinDistSampler::kMaxPoints});
  EXPECT_EQ(s.samplesPerPixel(), 2 * MaxMinDistSampler::kMaxPoints);
  EXPECT_NE(slotPoints(s, {0, 0}, 0, 0, 1), slotPoints(s, {0, 0}, 0, MaxMinDistSampler::kMaxPoints, 1));
}

}  // namespace
}  // namespace pbrtmedia
