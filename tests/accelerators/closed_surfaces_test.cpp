// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "accelerators/accelerator.h"
#include "accelerators/meshes.h"

// Rays on closed surfaces: none leaks, none stops at its own neighbourhood.

namespace pbrtmedia {
namespace {

using test::builtFrom;
using test::makeRay;
using test::Mesh;

/// A random walk of `chords` chords inside a closed mesh, leaving the walls at cosines above `minCosine`.
/// Returns how many rays found no wall.
int leaks(const Accelerator& a, const Mesh& mesh, Point3f start, int chords, float minCosine) {
  Rng rng(3);
  int count = 0;
  Point3f p = start;
  Exclusions exclusions;
  Vector3f d = test::randomDirection(rng);
  for (int i = 0; i < chords; ++i) {
    const auto hit = a.intersect(makeRay(p, d), 0, exclusions);
    if (!hit || hit->id.geometry != 0) {
      ++count;
      p = start;
      exclusions = {};
      d = test::randomDirection(rng);
      continue;
    }
    p = mesh.at(*hit);
    exclusions = Exclusions(hit->id);
    Vector3f local;
    do {
      const float u0 = rng.uniform(), u1 = rng.uniform();
      local = sampleCosineHemisphere({u0, u1});
    } while (local.z < minCosine);
    d = Frame::fromZ(Vector3f(-mesh.normal(hit->id.primitive))).toWorld(local);
  }
  return count;
}

/// Alone, and led through a tree.
int leaksOfBox(const Mesh& mesh, Point3f start, int chords, float minCosine = 0) {
  return leaks(builtFrom(mesh), mesh, start, chords, minCosine) +
         leaks(test::builtAsTreeFrom(mesh), mesh, start, chords, minCosine);
}

TEST(ClosedSurfaces, NoneOfAMillionChordsLeavesABox) {
  EXPECT_EQ(leaksOfBox(test::boxMesh(), {0, 0, 0}, 1000000), 0);
}

TEST(ClosedSurfaces, NoneOfAMillionChordsLeavesATurnedBoxFarFromTheOrigin) {
  // The vertices are rounded to 1.5e-5, so the halves of a face are tilted that much against each other.
  constexpr float kMinCosine = 1e-3f;
  const Transform t = Transform::translate({100, -200, 300}) * Transform::rotate(33, {1, 2, 3});
  EXPECT_EQ(leaksOfBox(test::boxMesh().transformed(t), {100, -200, 300}, 1000000, kMinCosine), 0);
}

TEST(ClosedSurfaces, NoneOfAMillionChordsLeavesASphereMesh) {
  const Mesh mesh = test::sphereMesh(5);
  EXPECT_EQ(leaks(builtFrom(mesh), mesh, {0, 0, 0}, 1000000, 0), 0);
}

TEST(ClosedSurfaces, NoRayStopsOnTheConvexMeshThatItLeaves) {
  // A fine mesh far from the origin: the start is rounded to about a thousandth of a triangle.
  const Transform t = Transform::translate({1000, 500, -700});
  const Mesh mesh = test::sphereMesh(5).transformed(t);
  const Accelerator a = builtFrom(mesh);
  Rng rng(11);
  int stopped = 0, occluded = 0, arrivalsStopped = 0;
  constexpr int kRays = 300000;
  for (int i = 0; i < kRays; ++i) {
    const std::uint32_t triangle = rng.uniformInt(static_cast<std::uint32_t>(mesh.indices.size()));
    const float u0 = rng.uniform(), u1 = rng.uniform(), u2 = rng.uniform(), u3 = rng.uniform();
    const Point2f b = sampleUniformTriangle({u0, u1});
    const Point3f p = mesh.at({.t = 0, .id = {PrimitiveId::kNone, 0, triangle}, .uv = {b.x, b.y}});
    // Cosines above 0.1: clear of the neighbours, whose normals differ by less.
    const float z = 0.1f + 0.9f * u2, r = std::sqrt(1 - z * z), phi = 2 * kPi * u3;
    const Vector3f d =
        Frame::fromZ(Vector3f(mesh.normal(triangle))).toWorld({r * std::cos(phi), r * std::sin(phi), z});
    const PrimitiveId id{PrimitiveId::kNone, 0, triangle};
    if (a.intersect(makeRay(p, d), 0, Exclusions(id))) ++stopped;
    if (a.occluded(makeRay(p, d), 0, Exclusions(id))) ++occluded;
    // The same way backwards, as a shadow ray that ends there. Its origin is rounded, so it may arrive beside
    // the stored end by a rounding of the coordinates; that is why the cosine is kept large.
    const Point3f far = p + 5.0f * d;
    if (a.occluded(makeRay(far, p - far, 1), 0, Exclusions(id, 1))) ++arrivalsStopped;
  }
  EXPECT_EQ(stopped, 0);
  EXPECT_EQ(occluded, 0);
  EXPECT_EQ(arrivalsStopped, 0);
}

/// Crossings of a whole line, found one by one: even for a closed surface.
int crossings(const Accelerator& a, const Ray& ray) {
  Exclusions exclusions;
  float t = 0;
  int count = 0;
  while (const auto hit = a.intersect(ray, t, exclusions)) {
    ++count;
    t = hit->t;
    exclusions.dropBefore(t);
    if (!exclusions.add(hit->id, t)) return -1;
  }
  return count;
}

// Embree's tests are watertight at edges. At corners they are not quite: of the lines aimed at exactly one,
// fewer than a hundredth slip through; none may count twice.
TEST(ClosedSurfaces, LinesCrossAConvexMeshTwiceEvenThroughItsEdgesAndCorners) {
  const Mesh mesh = test::sphereMesh(3);
  const Accelerator a = builtFrom(mesh);
  Rng rng(5);
  int wrong = 0, throughCorners = 0, slipped = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto& c = mesh.indices[rng.uniformInt(static_cast<std::uint32_t>(mesh.indices.size()))];
    // Through a corner, a point of an edge, or the middle of an edge, from an origin of few digits.
    const float along = i % 3 == 0 ? 0.0f : (i % 3 == 1 ? 0.5f : rng.uniform());
    const Point3f target = mesh.positions[c[0]] + along * (mesh.positions[c[1]] - mesh.positions[c[0]]);
    const Point3f origin(4 * (rng.uniform() < 0.5f ? -1.0f : 1.0f), std::floor(4 * rng.uniform()),
                         std::floor(4 * rng.uniform()));
    const Vector3f d = target - origin;
    // Not along the silhouette, where a line through an edge touches without crossing.
    if (std::abs(dot(normalize(d), normalize(target))) < 0.2f) continue;
    const int count = crossings(a, makeRay(origin, d));
    if (along == 0) ++throughCorners;
    if (along == 0 && count == 1) ++slipped;
    if (count != 2 && !(along == 0 && count == 1)) ++wrong;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(slipped, throughCorners / 100);
}

TEST(ClosedSurfaces, LinesAlongTheAxesCrossABoxTwice) {
  // Every ray goes exactly through a diagonal of the faces.
  const Mesh mesh = test::boxMesh();
  const Accelerator a = builtFrom(mesh);
  for (int i = -7; i <= 7; ++i) {
    const float x = static_cast<float>(i) / 8;
    EXPECT_EQ(crossings(a, makeRay({x, x, -5}, {0, 0, 1})), 2) << x;
    EXPECT_EQ(crossings(a, makeRay({x, -x, -5}, {0, 0, 1})), 2) << x;
    EXPECT_EQ(crossings(a, makeRay({-5, x, -x}, {1, 0, 0})), 2) << x;
    EXPECT_EQ(crossings(a, makeRay({x, 5, x}, {0, -2, 0})), 2) << x;
  }
}

TEST(ClosedSurfaces, AFaceSharedByTwoSlabsCountsTwice) {
  const Mesh lower = test::boxMesh();
  const Mesh upper = lower.transformed(Transform::translate({0, 0, 2}));
  Accelerator a;
  a.addTriangles(lower.buffers());
  a.addTriangles(upper.buffers());
  a.build();
  Rng rng(9);
  for (int i = 0; i < 20000; ++i) {
    const float x = 0.8f * (2 * rng.uniform() - 1), y = 0.8f * (2 * rng.uniform() - 1);
    const Vector3f d(0.1f * rng.uniform(), 0.1f * rng.uniform(), 1);
    ASSERT_EQ(crossings(a, makeRay(Point3f(x, y, 1) - 3.0f * d, d)), 4) << x << ' ' << y;
  }
}

}  // namespace
}  // namespace pbrtmedia
