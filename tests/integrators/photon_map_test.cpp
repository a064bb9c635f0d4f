// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

struct Point {
  Point3f p;
  int number = 0;
};

/// Some on a plane, some at the same place, one far away.
std::vector<Point> pointsOf(int count) {
  Rng rng(7);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    Point3f p(rng.uniform(), 2 * rng.uniform(), i % 3 == 0 ? 0 : rng.uniform());
    if (i % 10 == 0) p = {.5f, .5f, .5f};
    if (i == 5) p = {100, -100, 3};
    points.push_back({p, i});
  }
  return points;
}

std::vector<int> found(const PhotonMap<Point>& map, Point3f p, float radius) {
  std::vector<int> numbers;
  map.within(p, radius, [&](const Point& point, float distance2) {
    EXPECT_EQ(distance2, lengthSquared(point.p - p));
    numbers.push_back(point.number);
  });
  return numbers;
}

TEST(PhotonMap, FindsExactlyWhatIsWithinTheRadius) {
  for (const int count : {0, 1, 2, 7, 8, 9, 16, 17, 64, 65, 1000, 1023}) {
    const std::vector<Point> points = pointsOf(count);
    const PhotonMap<Point> map(points);
    ASSERT_EQ(map.size(), points.size());
    Rng rng(9);
    for (int i = 0; i < 50; ++i) {
      const Point3f p(1.5f * rng.uniform(), 2 * rng.uniform(), rng.uniform());
      const float radius = i == 0 ? 1000 : i == 1 ? 0 : .3f * rng.uniform();
      std::vector<int> numbers = found(map, p, radius), truth;
      std::sort(numbers.begin(), numbers.end());
      for (const Point& point : points) {
        if (lengthSquared(point.p - p) <= radius * radius) truth.push_back(point.number);
      }
      EXPECT_EQ(numbers, truth) << count << " points";
    }
  }
}

TEST(PhotonMap, FindsThePointItself) {
  const std::vector<Point> points = pointsOf(100);
  const PhotonMap<Point> map(points);
  EXPECT_EQ(found(map, {100, -100, 3}, 0), std::vector<int>{5});
  EXPECT_EQ(found(map, {.5f, .5f, .5f}, 0).size(), 10u);
}

TEST(PhotonMap, FindsInAnOrderThatThePointsDecide) {
  const std::vector<Point> points = pointsOf(500);
  const PhotonMap<Point> a(points), b(std::vector<Point>(points.rbegin(), points.rend()));
  const auto places = [](const PhotonMap<Point>& map) {
    std::vector<Point3f> all;
    map.within({.5f, 1, .5f}, .6f, [&](const Point& point, float) { all.push_back(point.p); });
    return all;
  };
  EXPECT_GT(places(a).size(), 100u);
  EXPECT_EQ(places(a), places(b));
}

}  // namespace
}  // namespace pbrtmedia
