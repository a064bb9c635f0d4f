// SPDX-License-Identifier: BSD-2-Clause
#include "base/bounds.h"

#include <gtest/gtest.h>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

const Bounds3d kBox{{-1, -2, -3}, {1, 2, 3}};

TEST(Bounds3, IsEmptyAtFirstAndNeutralInUnion) {
  Bounds3d b;
  EXPECT_TRUE(b.isEmpty());
  Bounds3d c = kBox;
  c.expand(b);
  EXPECT_EQ(c, kBox);
  b.expand(Vec3d{1, 2, 3});
  EXPECT_FALSE(b.isEmpty());
  EXPECT_EQ(b.min, b.max);
  b.expand(kBox);
  EXPECT_EQ(b, kBox);
}

TEST(Bounds3, KnowsItsCornersCentreAndInside) {
  EXPECT_EQ(kBox.corner(0), kBox.min);
  EXPECT_EQ(kBox.corner(7), kBox.max);
  EXPECT_EQ(kBox.corner(5), (Vec3d{1, -2, 3}));
  EXPECT_EQ(kBox.centre(), (Vec3d{0, 0, 0}));
  EXPECT_EQ(kBox.diagonal(), (Vec3d{2, 4, 6}));
  EXPECT_TRUE(kBox.contains({1, 2, 3}));
  EXPECT_FALSE(kBox.contains({1, 2, 3.001}));
}

TEST(Bounds3, CentreOfAHugeBoxDoesNotOverflow) {
  const float m = std::numeric_limits<float>::max();
  EXPECT_EQ((Bounds3f{{m / 2, m / 2, m / 2}, {m, m, m}}.centre().x), 0.75f * m);
}

TEST(Bounds2i, CountsPixelsOfAHalfOpenRectangle) {
  const Bounds2i b{{-1, 2}, {3, 5}};
  EXPECT_EQ(b.width(), 4);
  EXPECT_EQ(b.height(), 3);
  EXPECT_EQ(b.area(), 12);
  EXPECT_TRUE(b.contains({-1, 4}));
  EXPECT_FALSE(b.contains({3, 4}));
  EXPECT_EQ(intersect(b, Bounds2i{{0, 0}, {9, 3}}), (Bounds2i{{0, 2}, {3, 3}}));
  EXPECT_EQ(intersect(b, Bounds2i{{5, 5}, {9, 9}}).area(), 0);
  EXPECT_EQ((Bounds2i{{0, 0}, {1 << 20, 1 << 20}}.area()), std::int64_t{1} << 40);
}

TEST(ClipToBox, GivesEntryAndExit) {
  const auto s = clipToBox<double>(kBox, {-5, 0, 0}, {2, 0, 0}, 0, 100);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->tMin, 2.0);
  EXPECT_EQ(s->tMax, 3.0);
}

TEST(ClipToBox, KeepsTheGivenRangeInside) {
  const auto s = clipToBox<double>(kBox, {0, 0, 0}, {1, 1, 1}, 0.25, 0.5);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->tMin, 0.25);
  EXPECT_EQ(s->tMax, 0.5);
}

TEST(ClipToBox, MissesWhatIsBehindBesideOrBeyond) {
  EXPECT_FALSE(clipToBox<double>(kBox, {-5, 0, 0}, {-1, 0, 0}, 0, 100));
  EXPECT_FALSE(clipToBox<double>(kBox, {-5, 2.5, 0}, {1, 0, 0}, 0, 100));
  EXPECT_FALSE(clipToBox<double>(kBox, {-5, 0, 0}, {1, 0, 0}, 0, 3.9));
  EXPECT_FALSE(clipToBox<double>(kBox, {-5, 0, 0}, {1, 1, 0}, 0, 100));
}

TEST(ClipToBox, CountsARayInAFaceAsInside) {
  for (const double zero : {0.0, -0.0}) {
    const auto s = clipToBox<double>(kBox, {-5, 2, 3}, {1, zero, zero}, 0, 100);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->tMin, 4.0);
    EXPECT_EQ(s->tMax, 6.0);
  }
}

TEST(ClipToBox, TouchesACornerAtOnePoint) {
  const auto s = clipToBox<double>(kBox, {0, 3, 0}, {1, -1, 0}, 0, 100);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->tMin, s->tMax);
}

TEST(ClipToBox, NeverHitsAnEmptyBox) {
  for (const double d : {1.0, -1.0})
    EXPECT_FALSE(clipToBox<double>(Bounds3d{}, {0, 0, 0}, {d, d, d}, 0, 1e30));
}

TEST(ClipToBox, AgreesWithTestingPointsOnRandomLines) {
  Rng rng(4);
  const auto r = [&] { return 10 * rng.uniformDouble() - 5; };
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const double ox = r(), oy = r(), oz = r(), dx = r(), dy = r(), dz = r();
    const Vec3d o{ox, oy, oz}, d{dx, dy, dz};
    const auto s = clipToBox<double>(kBox, o, d, 0, 2);
    hits += s.has_value();
    for (int k = 0; k <= 50; ++k) {
      const double t = 2.0 * k / 50;
      const bool inside = kBox.contains(o + t * d), clipped = s && t >= s->tMin && t <= s->tMax;
      EXPECT_EQ(inside, clipped) << o << d << t;
    }
  }
  EXPECT_GT(hits, 300);
}

}  // namespace
}  // namespace pbrtmedia
