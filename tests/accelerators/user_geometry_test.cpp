// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "accelerators/accelerator.h"
#include "accelerators/meshes.h"

namespace pbrtmedia {
namespace {

using test::makeRay;

/// Two parallel unit squares at z = 1 and z = 2, as one curved primitive would be: two roots on a line.
class TwoSheets final : public UserGeometry {
 public:
  std::uint32_t primitiveCount() const override { return 1; }
  Bounds3f primitiveBounds(std::uint32_t) const override { return {{0, 0, 1}, {1, 1, 2}}; }
  std::optional<Root> intersect(std::uint32_t, const Ray& ray, double tMin, double tMax,
                                std::span<const float> excludedT) const override {
    const double roots[2] = {(1.0 - ray.o.z) / ray.d.z, (2.0 - ray.o.z) / ray.d.z};
    bool isOpen[2] = {true, true};
    for (const float e : excludedT) isOpen[std::abs(e - roots[0]) <= std::abs(e - roots[1]) ? 0 : 1] = false;
    std::optional<Root> best;
    for (int i = 0; i < 2; ++i) {
      const auto t = static_cast<float>(roots[i]);
      const Point3f p = ray.at(t);
      const bool isInside = p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1;
      if (!isOpen[i] || !isInside || t < tMin || t > tMax || (best && best->t < roots[i])) continue;
      best = Root{roots[i], {p.x, static_cast<float>(i)}};
    }
    return best;
  }
};

/// Unit squares in rows, number i at (i % 8, i / 8) and height i, all of them seen from below.
class ManySheets final : public UserGeometry {
 public:
  explicit ManySheets(std::uint32_t count) : count_(count) {}
  std::uint32_t primitiveCount() const override { return count_; }
  Bounds3f primitiveBounds(std::uint32_t i) const override {
    const Point3f corner = cornerOf(i);
    return {corner, corner + Vector3f{1, 1, 0}};
  }
  std::optional<Root> intersect(std::uint32_t i, const Ray& ray, double tMin, double tMax,
                                std::span<const float> excludedT) const override {
    const Point3f corner = cornerOf(i);
    const double t = (double{corner.z} - ray.o.z) / ray.d.z;
    const Vector3f at = ray.at(static_cast<float>(t)) - corner;
    const bool isInside = at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1;
    if (!isInside || !excludedT.empty() || t < tMin || t > tMax) return std::nullopt;
    return Root{t, {at.x, at.y}};
  }

 private:
  static Point3f cornerOf(std::uint32_t i) {
    return {static_cast<float>(i % 8), static_cast<float>(i / 8 % 8), static_cast<float>(i)};
  }
  std::uint32_t count_;
};

TEST(UserGeometry, OfManyPrimitivesNamesTheOneThatIsHit) {
  const ManySheets sheets(640);
  Accelerator a;
  EXPECT_EQ(a.addUser(sheets), 0u);
  a.build();
  EXPECT_EQ(a.bounds(), (Bounds3f{{0, 0, 0}, {8, 8, 639}}));
  for (std::uint32_t i = 0; i < 64; ++i) {
    // Ten sheets above each other: each is left out on its own.
    const Ray ray =
        makeRay({static_cast<float>(i % 8) + 0.25f, static_cast<float>(i / 8) + 0.5f, -1}, {0, 0, 1});
    Exclusions exclusions;
    for (std::uint32_t primitive = i; primitive < 640; primitive += 64) {
      const auto hit = a.intersect(ray, 0, exclusions);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->id, (PrimitiveId{PrimitiveId::kNone, 0, primitive}));
      EXPECT_EQ(hit->t, static_cast<float>(primitive) + 1);
      EXPECT_EQ(hit->uv, Point2f(0.25f, 0.5f));
      EXPECT_TRUE(a.occluded(ray, 0, exclusions));
      exclusions.add(hit->id, hit->t);
    }
    EXPECT_FALSE(a.intersect(ray, 0, exclusions));
    EXPECT_FALSE(a.occluded(ray, 0, exclusions));
  }
}

TEST(UserGeometry, OfManyPrimitivesIsFoundThroughInstances) {
  const ManySheets sheets(64);
  Accelerator object, a;
  object.addUser(sheets);
  object.build();
  a.addInstance(object, AnimatedTransform(Transform::translate({100, 0, 0})));
  a.addInstance(object, AnimatedTransform(Transform(), 0, Transform::translate({0, 0, 2}), 1));
  a.build();
  const auto fixed = a.intersect(makeRay({103.5f, 2.5f, -1}, {0, 0, 1}), 0, {});
  ASSERT_TRUE(fixed);
  EXPECT_EQ(fixed->id, (PrimitiveId{0, 0, 19}));
  const auto moving = a.intersect(makeRay({3.5f, 2.5f, -1}, {0, 0, 1}, kInfinity, 0.5f), 0, {});
  ASSERT_TRUE(moving);
  EXPECT_EQ(moving->id, (PrimitiveId{1, 0, 19}));
  EXPECT_FLOAT_EQ(moving->t, 21);
}

TEST(UserGeometry, WithoutPrimitivesIsNeverHit) {
  const ManySheets none(0), one(1);
  Accelerator a;
  a.addUser(none);
  EXPECT_EQ(a.addUser(one), 1u);
  a.build();
  const auto hit = a.intersect(makeRay({0.5f, 0.5f, -1}, {0, 0, 1}), 0, {});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->id, (PrimitiveId{PrimitiveId::kNone, 1, 0}));
}

TEST(UserGeometry, ReportsItsOwnNumbersAndIsExcludedRootByRoot) {
  const TwoSheets sheets;
  Accelerator a;
  EXPECT_EQ(a.addUser(sheets), 0u);
  a.build();
  const Ray ray = makeRay({0.25f, 0.5f, 0}, {0, 0, 1});
  const auto first = a.intersect(ray, 0, {});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->t, 1);
  EXPECT_EQ(first->id, (PrimitiveId{PrimitiveId::kNone, 0, 0}));
  EXPECT_EQ(first->uv, Point2f(0.25f, 0));
  Exclusions exclusions(first->id, first->t);
  const auto second = a.intersect(ray, first->t, exclusions);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->t, 2);
  EXPECT_TRUE(a.occluded(ray, first->t, exclusions));
  exclusions.add(second->id, second->t);
  EXPECT_FALSE(a.intersect(ray, 0, exclusions));
  EXPECT_FALSE(a.occluded(ray, 0, exclusions));
  EXPECT_FALSE(a.occluded(makeRay(ray.o, ray.d, 1), 0, {}));
}

TEST(UserGeometry, ARejectedRootGivesWayToTheNext) {
  struct OnlySecond final : HitFilter {
    bool accepts(const RayHit& hit, bool) const override { return hit.uv.y > 0.5f; }
  };
  struct Nothing final : HitFilter {
    bool accepts(const RayHit&, bool) const override { return false; }
  };
  const TwoSheets sheets;
  const OnlySecond second;
  const Nothing nothing;
  Accelerator a, b;
  a.addUser(sheets, &second);
  a.build();
  b.addUser(sheets, &nothing);
  b.build();
  const Ray ray = makeRay({0.25f, 0.5f, 0}, {0, 0, 1});
  const auto hit = a.intersect(ray, 0, {});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 2);
  EXPECT_FALSE(b.intersect(ray, 0, {}));
  EXPECT_FALSE(b.occluded(ray, 0, {}));
}

TEST(UserGeometry, IsFoundThroughInstances) {
  const TwoSheets sheets;
  Accelerator object;
  object.addUser(sheets);
  object.build();
  const Transform t = Transform::translate({0, 0, 5}) * Transform::scale(1, 1, 3);
  for (const AnimatedTransform& place :
       {AnimatedTransform(t),
        AnimatedTransform(Transform::translate({0, 0, 1}) * t, 0, Transform::translate({0, 0, -1}) * t, 1)}) {
    Accelerator a;
    a.addInstance(object, place);
    a.build();
    const Ray ray = makeRay({0.25f, 0.5f, 0}, {0, 0, 1}, kInfinity, 0.5f);
    const auto hit = a.intersect(ray, 0, {});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->t, 8);
    EXPECT_EQ(hit->id, (PrimitiveId{0, 0, 0}));
    const auto next = a.intersect(ray, hit->t, Exclusions(hit->id, hit->t));
    ASSERT_TRUE(next);
    EXPECT_FLOAT_EQ(next->t, 11);
  }
}

TEST(UserGeometry, CoincidentWithTrianglesBothAreFound) {
  const TwoSheets sheets;
  const test::Mesh mesh{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}}};
  Accelerator a;
  a.addUser(sheets);
  a.addTriangles(mesh.buffers());
  a.addUser(sheets);
  a.build();
  const Ray ray = makeRay({0.25f, 0.25f, 0}, {0, 0, 1});
  Exclusions exclusions;
  for (const std::uint32_t expected : {0u, 1u, 2u}) {
    const auto hit = a.intersect(ray, exclusions.isEmpty() ? 0 : 1, exclusions);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id.geometry, expected);
    EXPECT_EQ(hit->t, 1);
    exclusions.add(hit->id, hit->t);
  }
  const auto next = a.intersect(ray, 1, exclusions);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->t, 2);
}

}  // namespace
}  // namespace pbrtmedia
