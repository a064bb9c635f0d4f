// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/accelerator.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include "accelerators/meshes.h"

namespace pbrtmedia {
namespace {

using test::boxMesh;
using test::builtFrom;
using test::makeRay;
using test::Mesh;

/// The triangle (0,0) (1,0) (0,1) at height z.
Mesh triangleAt(float z) { return {{{0, 0, z}, {1, 0, z}, {0, 1, z}}, {{0, 1, 2}}}; }

TEST(Accelerator, MissesEverythingWhenNothingWasAdded) {
  Accelerator a;
  a.build();
  EXPECT_TRUE(a.isEmpty());
  EXPECT_TRUE(a.bounds().isEmpty());
  EXPECT_EQ(a.memoryBytes(), 0u);
  EXPECT_FALSE(a.intersect(makeRay({0, 0, 0}, {0, 0, 1}), 0, {}));
  EXPECT_FALSE(a.occluded(makeRay({0, 0, 0}, {0, 0, 1}), 0, {}));
}

TEST(Accelerator, ReportsDistanceIdAndBarycentricWeightsOfTheSecondAndThirdCorner) {
  const Mesh mesh = triangleAt(2);
  const Accelerator a = builtFrom(mesh);
  const auto hit = a.intersect(makeRay({0.5f, 0.25f, 0}, {0, 0, 1}), 0, {});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 2);
  EXPECT_EQ(hit->id, (PrimitiveId{PrimitiveId::kNone, 0, 0}));
  EXPECT_FLOAT_EQ(hit->uv.x, 0.5f);
  EXPECT_FLOAT_EQ(hit->uv.y, 0.25f);
  EXPECT_TRUE(a.occluded(makeRay({0.5f, 0.25f, 0}, {0, 0, 1}), 0, {}));
  EXPECT_FALSE(a.intersect(makeRay({0.75f, 0.5f, 0}, {0, 0, 1}), 0, {}));
  EXPECT_EQ(a.bounds(), (Bounds3f{{0, 0, 2}, {1, 1, 2}}));
  EXPECT_GT(a.memoryBytes(), 0u);
}

TEST(Accelerator, CountsAHitAtTMinButNotAtTMax) {
  const Mesh mesh = triangleAt(2);
  const Accelerator a = builtFrom(mesh);
  const float below = std::nextafter(2.0f, 0.0f), above = std::nextafter(2.0f, 3.0f);
  const auto hits = [&](float tMin, float tMax) {
    const Ray ray = makeRay({0.25f, 0.25f, 0}, {0, 0, 1}, tMax);
    const bool hit = a.intersect(ray, tMin, {}).has_value();
    EXPECT_EQ(a.occluded(ray, tMin, {}), hit);
    return hit;
  };
  EXPECT_TRUE(hits(2, kInfinity));
  EXPECT_FALSE(hits(above, kInfinity));
  EXPECT_TRUE(hits(below, above));
  EXPECT_FALSE(hits(0, 2));
  EXPECT_TRUE(hits(0, above));
  const Ray onIt = makeRay({0.25f, 0.25f, 2}, {0, 0, 1});
  ASSERT_TRUE(a.intersect(onIt, 0, {}));
  EXPECT_EQ(a.intersect(onIt, 0, {})->t, 0);
}

TEST(Accelerator, LeavesOutExcludedTriangles) {
  const Mesh near = triangleAt(1), far = triangleAt(2);
  Accelerator a;
  EXPECT_EQ(a.addTriangles(near.buffers()), 0u);
  EXPECT_EQ(a.addTriangles(far.buffers()), 1u);
  a.build();
  const Ray ray = makeRay({0.25f, 0.25f, 0}, {0, 0, 1});
  Exclusions exclusions;
  const auto first = a.intersect(ray, 0, exclusions);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->id.geometry, 0u);
  exclusions.add(first->id, first->t);
  const auto second = a.intersect(ray, first->t, exclusions);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->id.geometry, 1u);
  exclusions.add(second->id, second->t);
  EXPECT_FALSE(a.intersect(ray, second->t, exclusions));
  EXPECT_FALSE(a.occluded(ray, 0, exclusions));
  // The same numbers in another instance are another primitive.
  EXPECT_TRUE(a.intersect(ray, 0, Exclusions({7, 0, 0}, 1)));
}

TEST(Accelerator, FindsEveryOneOfCoincidentTrianglesInOrderOfTheirNumbers) {
  constexpr std::uint32_t kCopies = 7;
  const Mesh mesh = triangleAt(0.3f);
  Accelerator a;
  for (std::uint32_t i = 0; i < kCopies; ++i) a.addTriangles(mesh.buffers());
  a.build();
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const float x = 0.1f + 0.3f * rng.uniform(), y = 0.1f + 0.3f * rng.uniform();
    const Vector3f d(x - 0.2f, y + 0.1f, 0.3f + 1);
    const Ray ray = makeRay({0.2f, -0.1f, -1}, d);
    Exclusions exclusions;
    float t = 0;
    for (std::uint32_t k = 0; k < kCopies; ++k) {
      const auto hit = a.intersect(ray, t, exclusions);
      ASSERT_TRUE(hit) << "copy " << k;
      EXPECT_EQ(hit->id.geometry, k);
      if (k > 0) {
        EXPECT_EQ(hit->t, t);
      }
      t = hit->t;
      exclusions.add(hit->id, t);
    }
    EXPECT_FALSE(a.intersect(ray, t, exclusions));
  }
}

TEST(Accelerator, FiltersSeeTheHitAndTheKindOfRay) {
  struct Holes final : HitFilter {
    bool accepts(const RayHit& hit, bool shadowRay) const override {
      return shadowRay ? hit.uv.x > 0.5f : hit.uv.x < 0.5f;
    }
  };
  const Holes holes;
  const Mesh mesh = triangleAt(1), behind = triangleAt(5);
  Accelerator a;
  a.addTriangles(mesh.buffers(), &holes);
  a.addTriangles(behind.buffers());
  a.build();
  const Ray left = makeRay({0.25f, 0.25f, 0}, {0, 0, 1}, 3), right = makeRay({0.6f, 0.25f, 0}, {0, 0, 1}, 3);
  EXPECT_TRUE(a.intersect(left, 0, {}));
  EXPECT_FALSE(a.occluded(left, 0, {}));
  EXPECT_FALSE(a.intersect(right, 0, {}));
  EXPECT_TRUE(a.occluded(right, 0, {}));
  const auto through = a.intersect(makeRay(right.o, right.d), 0, {});
  ASSERT_TRUE(through);
  EXPECT_EQ(through->id.geometry, 1u);
}

TEST(Accelerator, MissesWithRaysThatAreNotNumbers) {
  const Mesh mesh = boxMesh();
  const Accelerator a = builtFrom(mesh);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Ray& ray : {makeRay({nan, 0, 0}, {0, 0, 1}), makeRay({0, 0, 0}, {0, nan, 1}),
                         makeRay({0, 0, 0}, {kInfinity, 0, 0}), makeRay({0, 0, 0}, {0, 0, 1}, nan)}) {
    EXPECT_FALSE(a.intersect(ray, 0, {}));
    EXPECT_FALSE(a.occluded(ray, 0, {}));
  }
  EXPECT_TRUE(a.intersect(makeRay({0, 0, 0}, {0, 0, 1}), 0, {}));
}

TEST(Accelerator, MissesWithRaysFromBeyondItsRange) {
  const Mesh mesh = test::sphereMesh(1);
  const Accelerator a = builtFrom(mesh);
  for (const float far : {1.9e18f, 1e30f, 3.4e38f}) {
    const Ray from = makeRay({far, 0, 0}, {-1, 0, 0}), along = makeRay({-2, 0, 0}, {far, 0, 0});
    for (const Ray& ray : {from, along}) {
      EXPECT_FALSE(a.intersect(ray, 0, {}));
      EXPECT_FALSE(a.occluded(ray, 0, {}));
    }
  }
  EXPECT_TRUE(a.intersect(makeRay({-1e3f, 0, 0}, {1e3f, 0, 0}), 0, {}));
}

TEST(Accelerator, RejectsCoordinatesItCannotHold) {
  Mesh mesh = triangleAt(1);
  mesh.positions[1].x = 1e19f;
  Accelerator a;
  EXPECT_THROW(a.addTriangles(mesh.buffers()), std::invalid_argument);
  mesh.positions[1].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(a.addTriangles(mesh.buffers()), std::invalid_argument);
  mesh = triangleAt(1);
  mesh.positions.emplace_back(kInfinity, 0, 0);  // of no triangle
  EXPECT_EQ(a.addTriangles(mesh.buffers()), 0u);
  a.build();
  EXPECT_TRUE(a.intersect(makeRay({0.25f, 0.25f, 0}, {0, 0, 1}), 0, {}));
}

TEST(Accelerator, KeepsNumbersOfMeshesWithoutTriangles) {
  const Mesh empty, mesh = triangleAt(1);
  Accelerator a;
  EXPECT_EQ(a.addTriangles(empty.buffers()), 0u);
  EXPECT_EQ(a.addTriangles(mesh.buffers()), 1u);
  a.build();
  const auto hit = a.intersect(makeRay({0.25f, 0.25f, 0}, {0, 0, 1}), 0, {});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->id.geometry, 1u);
}

TEST(Accelerator, WorksAfterBeingMoved) {
  const Mesh mesh = boxMesh();
  Accelerator a = builtFrom(mesh);
  const Accelerator b = std::move(a);
  EXPECT_TRUE(b.intersect(makeRay({0, 0, 0}, {0, 0, 1}), 0, {}));
}

TEST(Accelerator, LeavesTheFloatingPointModeAlone) {
  const unsigned before = _mm_getcsr() & ~_MM_EXCEPT_MASK;
  const Mesh mesh = test::sphereMesh(4);
  const Accelerator a = builtFrom(mesh);
  ASSERT_TRUE(a.intersect(makeRay({0, 0, 0}, {0.1f, 0.2f, 1}), 0, {}));
  EXPECT_EQ(_mm_getcsr() & ~_MM_EXCEPT_MASK, before);
}

}  // namespace
}  // namespace pbrtmedia
