// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/few_shapes.h"

#include <gtest/gtest.h>

#include <map>

#include "accelerators/meshes.h"

namespace pbrtmedia {
namespace {

using test::boxMesh;
using test::makeRay;
using test::Mesh;

struct Crossing {
  double t, leastWeight;
};

/// By Moeller and Trumbore's formulas, doi:10.1080/10867651.1997.10487468, and to both sides of every edge.
std::map<std::uint32_t, Crossing> crossingsOneByOne(const Mesh& mesh, const Ray& ray) {
  std::map<std::uint32_t, Crossing> found;
  for (std::uint32_t i = 0; i < mesh.indices.size(); ++i) {
    const auto& c = mesh.indices[i];
    const Vec3d a(mesh.positions[c[0]]), ab = Vec3d(mesh.positions[c[1]]) - a,
                                         ac = Vec3d(mesh.positions[c[2]]) - a, d(ray.d),
                                         ao = Vec3d(ray.o) - a;
    const Vec3d p = cross(d, ac), q = cross(ao, ab);
    const double determinant = dot(ab, p);
    if (determinant == 0) continue;
    const double v = dot(ao, p) / determinant, w = dot(d, q) / determinant;
    found[i] = {dot(ac, q) / determinant, std::min({1 - v - w, v, w})};
  }
  return found;
}

Mesh boxWithout(std::size_t triangles) {
  Mesh mesh = boxMesh();
  mesh.indices.resize(mesh.indices.size() - triangles);
  return mesh;
}
Mesh dentedBox() {
  Mesh mesh = boxMesh();
  mesh.positions[7] = {0.25f, 0.25f, 0.25f};
  return mesh;
}
Mesh boxTwice() {
  Mesh mesh = boxMesh();
  const auto once = mesh.indices;
  mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
  return mesh;
}
Mesh boxWithOverlaps() {
  Mesh mesh = boxMesh();
  mesh.indices[3] = {1, 2, 0};  // the half of the bottom that is there
  return mesh;
}
const Transform kTurn = Transform::translate({10, -20, 30}) * Transform::rotate(33, {1, 2, 3});

struct Case {
  const char* name;
  Mesh mesh;
};
const std::vector<Case>& cases() {
  static const std::vector<Case> kCases{{"box", boxMesh()},
                                        {"turned box", boxMesh().transformed(kTurn)},
                                        {"octahedron", test::sphereMesh(0)},
                                        {"box without a face", boxWithout(2)},
                                        {"box without half a face", boxWithout(1)},
                                        {"dented box", dentedBox()},
                                        {"turned dented box", dentedBox().transformed(kTurn)},
                                        {"box twice", boxTwice()},
                                        {"box with a face that overlaps", boxWithOverlaps()}};
  return kCases;
}

Point3f somewhere(const Mesh& mesh, Rng& rng, float size) {
  Vec3d middle{};
  for (const Point3f& p : mesh.positions) middle += Vec3d(p) / static_cast<double>(mesh.positions.size());
  return Point3f(middle + Vec3d(test::randomPoint(rng, size)));
}

TEST(FewShapes, CrossingsAreThoseOfEveryTriangle) {
  constexpr double kAway = 1e-6;  // from edges, where rounding may decide
  for (const Case& c : cases()) {
    GeometryRecord record;
    record.triangles = c.mesh.buffers();
    const FewShapes::Item item(record);
    Rng rng(5);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
      const Point3f o = somewhere(c.mesh, rng, i % 2 ? 0.9f : 4.0f), to = somewhere(c.mesh, rng, 1.1f);
      const Ray ray = makeRay(o, normalize(to - o));
      const float tMin = i % 3 ? 0 : 0.5f, tMax = i % 5 ? kInfinity : 2.0f;
      std::map<std::uint32_t, FewShapes::Crossing> found;
      item.visitCrossings(
          FewShapes::Line(ray), tMin, [&] { return tMax; },
          [&](const FewShapes::Crossing& at) { found[at.primitive] = at; });
      for (const auto& [primitive, at] : found) EXPECT_TRUE(at.t >= tMin && at.t <= tMax) << c.name;
      for (const auto& [primitive, expected] : crossingsOneByOne(c.mesh, ray)) {
        if (std::abs(expected.leastWeight) < kAway || std::abs(expected.t - tMin) < kAway ||
            std::abs(expected.t - tMax) < kAway)
          continue;
        const bool isThere = expected.leastWeight > 0 && expected.t > tMin && expected.t < tMax;
        ASSERT_EQ(found.count(primitive), isThere ? 1u : 0u) << c.name << ": line " << i << ", " << primitive;
        if (!isThere) continue;
        ++met;
        EXPECT_NEAR(found[primitive].t, expected.t, 1e-6 * (1 + expected.t)) << c.name;
        EXPECT_TRUE(item.mayMeet(FewShapes::Line(ray), tMin, tMax)) << c.name;
      }
    }
    EXPECT_GT(met, 5000) << c.name;
  }
}

TEST(FewShapes, ALineThroughACommonEdgeMeetsOneOfTheNeighboursOrBoth) {
  const Mesh mesh = boxMesh().transformed(kTurn);
  GeometryRecord record;
  record.triangles = mesh.buffers();
  const FewShapes::Item item(record);
  Rng rng(7);
  for (int i = 0; i < 20000; ++i) {
    const auto& corners = mesh.indices[static_cast<std::size_t>(i) % mesh.indices.size()];
    const Point3f o = somewhere(mesh, rng, 0.5f), a = mesh.positions[corners[0]],
                  b = mesh.positions[corners[1]];
    const float u = rng.uniform();
    int count = 0;
    item.visitCrossings(
        FewShapes::Line(makeRay(o, normalize(a + u * (b - a) - o))), 0, [] { return kInfinity; },
        [&](const FewShapes::Crossing&) { ++count; });
    ASSERT_GE(count, 1) << i;
  }
}

TEST(FewShapes, AreNotManyNorInstances) {
  const Mesh box = boxMesh(), sphere = test::sphereMesh(2);
  std::vector<std::unique_ptr<GeometryRecord>> records;
  const auto add = [&](const Mesh& mesh) {
    records.push_back(std::make_unique<GeometryRecord>());
    records.back()->triangles = mesh.buffers();
  };
  add(box);
  ASSERT_TRUE(FewShapes::of(records));
  EXPECT_EQ(FewShapes::of(records)->items().size(), 1u);
  add(sphere);
  EXPECT_FALSE(FewShapes::of(records));
  records.pop_back();
  records.push_back(std::make_unique<GeometryRecord>());  // a mesh without triangles
  EXPECT_TRUE(FewShapes::of(records));
  const Accelerator::Impl object;
  records.back()->object = &object;
  EXPECT_FALSE(FewShapes::of(records));
}

/// The same box alone and beside a mesh of many triangles, which are led through a tree.
TEST(FewShapes, AndATreeMeetTheSame) {
  const Mesh box = boxMesh().transformed(kTurn);
  const Accelerator few = test::builtFrom(box), tree = test::builtAsTreeFrom(box);
  Rng rng(9);
  int met = 0;
  for (int i = 0; i < 50000; ++i) {
    const Point3f o = somewhere(box, rng, i % 2 ? 0.9f : 4.0f), to = somewhere(box, rng, 1.5f);
    const Ray ray = makeRay(o, normalize(to - o), 20);
    const auto first = few.intersect(ray, 0, {}), same = tree.intersect(ray, 0, {});
    ASSERT_EQ(first.has_value(), same.has_value()) << i;
    ASSERT_EQ(few.occluded(ray, 0, {}), same.has_value()) << i;
    if (!first) continue;
    ++met;
    EXPECT_NEAR(first->t, same->t, 1e-5) << i;
    const float weight = std::min({first->uv.x, first->uv.y, 1 - first->uv.x - first->uv.y});
    if (weight > 1e-4f) {
      EXPECT_EQ(first->id, same->id) << i;
      EXPECT_NEAR(first->uv.x, same->uv.x, 1e-4) << i;
      EXPECT_NEAR(first->uv.y, same->uv.y, 1e-4) << i;
    }
    const Exclusions past(first->id, first->t);
    const auto second = few.intersect(ray, std::nextafter(first->t, 0.0f), past),
               other = tree.intersect(ray, std::nextafter(same->t, 0.0f), Exclusions(same->id, same->t));
    ASSERT_EQ(second.has_value(), other.has_value()) << i;
  }
  EXPECT_GT(met, 30000);
}

}  // namespace
}  // namespace pbrtmedia
