// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "base/rng.h"
#include "textures/mapping2d.h"
#include "textures/mapping3d.h"
#include "textures/texture_test_support.h"

namespace pbrtmedia {
namespace {

using test::atPoint;
using test::atUv;

TEST(UvMapping, ScalesBeforeItShifts) {
  SurfaceInteraction si = atUv(0.25f, 0.5f);
  si.dudx = 1;
  si.dvdx = 2;
  si.dudy = 3;
  si.dvdy = 4;
  const TexCoord2 at = mapPoint(UvMapping{2, 4, 0.5f, -1}, si);
  EXPECT_EQ(at.st, Point2f(1, 1));
  EXPECT_EQ(at.dstdx, Vector2f(2, 8));
  EXPECT_EQ(at.dstdy, Vector2f(6, 16));
}

TEST(UvMapping, IsTheIdentityByDefault) {
  EXPECT_EQ(mapPoint(Mapping2d{}, atUv(0.25f, 0.75f)).st, Point2f(0.25f, 0.75f));
}

TEST(SphericalMapping, PutsThePolarAngleInSAndTheAzimuthInT) {
  const SphericalMapping map{Transform{}};
  const auto expectSt = [&](Point3f p, float s, float t) {
    const Point2f st = map(atPoint(p)).st;
    EXPECT_NEAR(st.x, s, 1e-6f) << p;
    EXPECT_NEAR(st.y, t, 1e-6f) << p;
  };
  expectSt({0, 0, 5}, 0, 0);
  expectSt({0, 0, -5}, 1, 0);
  expectSt({3, 0, 0}, 0.5f, 0);
  expectSt({0, 3, 0}, 0.5f, 0.25f);
  expectSt({-3, 0, 0}, 0.5f, 0.5f);
  expectSt({0, -3, 0}, 0.5f, 0.75f);
  expectSt({2, 0, 2}, 0.25f, 0);
}

TEST(SphericalMapping, UsesTheInverseOfTheCtm) {
  const SphericalMapping map{Transform::translate({1, 2, 3}) * Transform::scale(2, 2, 2)};
  const Point2f st = map(atPoint({1, 3, 3})).st;
  EXPECT_NEAR(st.x, 0.5f, 1e-6f);
  EXPECT_NEAR(st.y, 0.25f, 1e-6f);
}

TEST(CylindricalMapping, HasTheZOfTheNormalisedVectorInT) {
  const CylindricalMapping map{Transform{}};
  const auto expectSt = [&](Point3f p, float s, float t) {
    const Point2f st = map(atPoint(p)).st;
    EXPECT_NEAR(st.x, s, 1e-6f) << p;
    EXPECT_NEAR(st.y, t, 1e-6f) << p;
  };
  expectSt({2, 0, 0}, 0.5f, 0);
  expectSt({0, 2, 0}, 0.75f, 0);
  expectSt({0, -2, 0}, 0.25f, 0);
  expectSt({3, 0, 4}, 0.5f, 0.8f);  // not 4
  expectSt({0, 0, -2}, 0.5f, -1);
}

TEST(PlanarMapping, ProjectsTheWorldPointOnItsVectors) {
  SurfaceInteraction si = atPoint({1, 2, 3});
  si.dpdx = {0.5f, 0, 0};
  si.dpdy = {0, 0, 0.25f};
  const TexCoord2 at = mapPoint(PlanarMapping{{2, 0, 0}, {0, 1, 4}, 10, 20}, si);
  EXPECT_EQ(at.st, Point2f(12, 34));
  EXPECT_EQ(at.dstdx, Vector2f(1, 0));
  EXPECT_EQ(at.dstdy, Vector2f(0, 1));
}

TEST(Mapping3d, AppliesTheForwardMatrixAsPbrtDoes) {
  SurfaceInteraction si = atPoint({1, 2, 3});
  si.dpdx = {1, 0, 0};
  si.dpdy = {0, 1, 0};
  const TexCoord3 at = Mapping3d(Transform::translate({10, 0, 0}) * Transform::scale(2, 3, 4))(si);
  EXPECT_EQ(at.p, Point3f(12, 6, 12));
  EXPECT_EQ(at.dpdx, Vector3f(2, 0, 0));
  EXPECT_EQ(at.dpdy, Vector3f(0, 3, 0));
}

/// Central differences of a mapping with a step that float still resolves.
template <class Map>
void expectDerivatives(const Map& map, std::uint64_t seed) {
  Rng rng(seed);
  const auto coordinate = [&] { return 2 * rng.uniform() - 1; };
  for (int i = 0; i < 200; ++i) {
    SurfaceInteraction si = atPoint({coordinate(), coordinate(), coordinate()});
    if (std::hypot(si.p.x, si.p.y) < 0.2f || (std::abs(si.p.y) < 0.05f)) continue;  // pole and seams
    si.dpdx = {coordinate(), coordinate(), coordinate()};
    constexpr float kStep = 1e-3f;
    const TexCoord2 at = map(si);
    const Point2f after = map(atPoint(si.p + kStep * si.dpdx)).st;
    const Point2f before = map(atPoint(si.p - kStep * si.dpdx)).st;
    const Vector2f expected = (after - before) / (2 * kStep);
    EXPECT_NEAR(at.dstdx.x, std::clamp(expected.x, -0.5f, 0.5f), 2e-3f) << si.p << si.dpdx;
    EXPECT_NEAR(at.dstdx.y, expected.y, 2e-3f) << si.p << si.dpdx;
    EXPECT_EQ(at.dstdy, Vector2f(0, 0));
  }
}

TEST(CylindricalMapping, KnowsItsDerivatives) { expectDerivatives(CylindricalMapping{Transform{}}, 1); }

TEST(SphericalMapping, KnowsItsDerivatives) {
  // t may change by half a turn at most, s by any amount.
  const SphericalMapping map{Transform{}};
  const auto swapped = [&](const SurfaceInteraction& si) {
    const TexCoord2 at = map(si);
    return TexCoord2{{at.st.y, at.st.x}, {at.dstdx.y, at.dstdx.x}, {at.dstdy.y, at.dstdy.x}};
  };
  expectDerivatives(swapped, 2);
}

TEST(SphericalMapping, SeesHalfATurnAtThePoleAndNothingWithoutAFootprint) {
  const SphericalMapping map{Transform{}};
  SurfaceInteraction si = atPoint({0, 0, 2});
  EXPECT_EQ(map(si).dstdx, Vector2f(0, 0));
  si.dpdx = {0.5f, 0, 0};
  EXPECT_EQ(map(si).dstdx.y, 0.5f);
  EXPECT_NEAR(map(si).dstdx.x, 0.25f * kInvPi, 1e-6f);  // dθ = 0.5 / 2
  EXPECT_EQ(map(atPoint({0, 0, 0})).dstdx, Vector2f(0, 0));
}

}  // namespace
}  // namespace pbrtmedia
