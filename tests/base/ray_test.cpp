// SPDX-License-Identifier: BSD-2-Clause
#include "base/ray.h"

#include <gtest/gtest.h>

#include "base/segment.h"

namespace pbrtmedia {
namespace {

TEST(Ray, StartsAtItsOriginAndMovesAlongItsDirection) {
  const Ray ray{{1, 2, 3}, {0, 0, 2}};
  EXPECT_EQ(ray.at(0), ray.o);
  EXPECT_EQ(ray.at(1.5f), (Point3f{1, 2, 6}));
  EXPECT_EQ(ray.tMax, kInfinity);
}

TEST(RayDifferential, ScalesTheOffsetsOfItsNeighboursOnly) {
  RayDifferential ray(Ray{{1, 0, 0}, {0, 0, 1}});
  ray.rxOrigin = {3, 0, 0};
  ray.ryOrigin = {1, 4, 0};
  ray.rxDirection = {1, 0, 1};
  ray.ryDirection = {0, 2, 1};
  ray.scaleDifferentials(0.5f);
  EXPECT_EQ(ray.rxOrigin, (Point3f{2, 0, 0}));
  EXPECT_EQ(ray.ryOrigin, (Point3f{1, 2, 0}));
  EXPECT_EQ(ray.rxDirection, (Vector3f{0.5f, 0, 1}));
  EXPECT_EQ(ray.ryDirection, (Vector3f{0, 1, 1}));
  EXPECT_EQ(ray.o, (Point3f{1, 0, 0}));
}

TEST(Segment, MeasuresItsParameterAndKeepsDigitsFarAway) {
  const Segment s{{1, 0, 0}, {0, 2, 0}, 3, 5};
  EXPECT_EQ(s.length(), 2.0);
  EXPECT_EQ(s.at(3), (Point3f{1, 6, 0}));
  // t is double: 2^30 + 1 is no float.
  EXPECT_EQ((Segment{{-0x1p30f, 0, 0}, {1, 0, 0}, 0, 1}.at(0x1p30 + 1)), (Point3f{1, 0, 0}));
}

}  // namespace
}  // namespace pbrtmedia
