// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/triangle_mesh.h"

#include <gtest/gtest.h>

#include "shapes/shape_probe.h"

namespace pbrtmedia {
namespace {

using test::makeRay;
using test::Probe;

/// (0,0) (1,0) (0,1) in z = 0, counter-clockwise seen from +z.
TriangleMesh::Params oneTriangle() {
  TriangleMesh::Params m;
  m.P = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  m.indices = {0, 1, 2};
  return m;
}

TriangleMesh::Params box() {
  TriangleMesh::Params m;
  for (int i = 0; i < 8; ++i) m.P.emplace_back(i & 1 ? 1.0f : 0.0f, i & 2 ? 1.0f : 0.0f, i & 4 ? 1.0f : 0.0f);
  m.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
               2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return m;
}

SurfaceInteraction hitFromAbove(const TriangleMesh& mesh, float x = 0.25f, float y = 0.5f) {
  const auto si = Probe(mesh).at(makeRay({x, y, 5}, {0, 0, -1}));
  if (!si) throw std::logic_error("the test ray must hit");
  return *si;
}

TEST(TriangleMesh, HitsHaveInterpolatedPointsAndDefaultParameters) {
  const TriangleMesh mesh(oneTriangle(), {});
  EXPECT_EQ(mesh.typeName(), "trianglemesh");
  EXPECT_EQ(mesh.primitiveCount(), 1u);
  EXPECT_EQ(mesh.area(0), 0.5);
  const auto si = hitFromAbove(mesh);
  EXPECT_EQ(si.p, Point3f(0.25f, 0.5f, 0));
  EXPECT_EQ(si.n, Normal3f(0, 0, 1));
  EXPECT_EQ(si.wo, Vector3f(0, 0, 1));
  // Corners (0,0), (1,0), (1,1): u = b1 + b2, v = b2.
  EXPECT_FLOAT_EQ(si.uv.x, 0.75f);
  EXPECT_FLOAT_EQ(si.uv.y, 0.5f);
  EXPECT_FLOAT_EQ(si.dpdu.x, 1);
  EXPECT_FLOAT_EQ(si.dpdu.y, 0);
  EXPECT_FLOAT_EQ(si.dpdv.x, -1);
  EXPECT_FLOAT_EQ(si.dpdv.y, 1);
  EXPECT_EQ(si.shading.dpdu, si.dpdu);
  EXPECT_EQ(si.faceIndex, 0u);
}

TEST(TriangleMesh, UsesGivenParametersAndFaceNumbers) {
  auto params = oneTriangle();
  params.uv = {{2, 3}, {2, 5}, {6, 3}};
  params.faceIndices = {42};
  const TriangleMesh mesh(params, {});
  const auto si = hitFromAbove(mesh);
  EXPECT_FLOAT_EQ(si.uv.x, 2 + 0.5f * 4);
  EXPECT_FLOAT_EQ(si.uv.y, 3 + 0.25f * 2);
  EXPECT_FLOAT_EQ(si.dpdu.y, 0.25f);
  EXPECT_FLOAT_EQ(si.dpdv.x, 0.5f);
  EXPECT_EQ(si.faceIndex, 42u);
  const auto hit = Probe(mesh).hit(makeRay({0.25f, 0.5f, 5}, {0, 0, -1}));
  EXPECT_FLOAT_EQ(mesh.uvAt(*hit).x, si.uv.x);
  EXPECT_FLOAT_EQ(mesh.uvAt(*hit).y, si.uv.y);
}

TEST(TriangleMesh, DegenerateParametersGiveAnOrthonormalTangentFrame) {
  auto params = oneTriangle();
  params.uv = {{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}};
  const auto si = hitFromAbove(TriangleMesh(params, {}));
  EXPECT_NEAR(length(si.dpdu), 1, 1e-6f);
  EXPECT_NEAR(length(si.dpdv), 1, 1e-6f);
  EXPECT_NEAR(dot(si.dpdu, si.dpdv), 0, 1e-6f);
  EXPECT_NEAR(dot(si.dpdu, si.n), 0, 1e-6f);
  EXPECT_EQ(si.uv, Point2f(0.5f, 0.5f));
}

/// The table of scene-language reference 13.1: z of the geometric normal for the four placements.
std::array<float, 4> normals(const TriangleMesh::Params& params) {
  const Transform mirror = Transform::scale(1, -1, 1);
  std::array<float, 4> z{};
  int i = 0;
  for (const ShapePlacement& place : {ShapePlacement{{}, false}, ShapePlacement{{}, true},
                                      ShapePlacement{mirror, false}, ShapePlacement{mirror, true}}) {
    const TriangleMesh mesh(params, place);
    const bool isMirrored = place.worldFromObject.swapsHandedness();
    const auto si = hitFromAbove(mesh, 0.25f, isMirrored ? -0.5f : 0.5f);
    z[static_cast<std::size_t>(i++)] = si.n.z;
    EXPECT_EQ(mesh.sample(0, {0.3f, 0.6f}).n, si.n) << "emission agrees with hits";
    EXPECT_GE(dot(si.n, si.shading.n), 0);
  }
  return z;
}

TEST(TriangleMesh, OrientationFollowsTheTable) {
  auto params = oneTriangle();
  using Four = std::array<float, 4>;
  EXPECT_EQ(normals(params), (Four{1, -1, 1, -1}));  // a mirror alone keeps the front
  params.S.assign(3, {1, 0, 0});
  EXPECT_EQ(normals(params), (Four{1, 1, 1, 1}));  // with S alone ReverseOrientation cancels itself
  params.N.assign(3, {0, 0, 1});
  EXPECT_EQ(normals(params), (Four{1, -1, 1, -1}));
  params.N.assign(3, {0, 0, -1});
  EXPECT_EQ(normals(params), (Four{-1, 1, -1, 1}));
  params.S.clear();
  EXPECT_EQ(normals(params), (Four{-1, 1, -1, 1}));
  params.N.assign(3, {0, 0, 0});  // no direction: as without N
  EXPECT_EQ(normals(params), (Four{1, -1, 1, -1}));
}

TEST(TriangleMesh, InterpolatesNormalsAndTheirDerivatives) {
  auto params = oneTriangle();
  params.N = {{0, 0, 2}, {1, 0, 1}, {0, 1, 1}};
  params.uv = {{0, 0}, {1, 0}, {0, 1}};  // u = x, v = y
  const TriangleMesh mesh(params, {});
  const auto si = hitFromAbove(mesh);
  const Vec3d raw = 0.25 * Vec3d(0, 0, 2) + 0.25 * Vec3d(1, 0, 1) + 0.5 * Vec3d(0, 1, 1), n = normalize(raw);
  EXPECT_LT(length(Vec3d(si.shading.n) - n), 1e-6);
  // Of N as given, as in PBRT-v3.
  EXPECT_LT(length(si.shading.dndu - Normal3f(1, 0, -1)), 1e-6f);
  EXPECT_LT(length(si.shading.dndv - Normal3f(0, 1, -1)), 1e-6f);
}

TEST(TriangleMesh, DerivativesOfNormalsFollowTheTransformationAsInPbrt) {
  auto params = oneTriangle();
  params.N = {{0, 0, 2}, {1, 0, 1}, {0, 1, 1}};
  params.uv = {{0, 0}, {1, 0}, {0, 1}};
  const Transform half = Transform::scale(0.5, 0.5, 0.5);
  for (const bool reverse : {false, true}) {
    const auto si = hitFromAbove(TriangleMesh(params, {half, reverse}), 0.125f, 0.125f);
    EXPECT_LT(length(si.shading.dndu - Normal3f(2, 0, -2)), 1e-6f) << "by 1/scale, ReverseOrientation or not";
    EXPECT_EQ(si.shading.n.z < 0, reverse);
  }
}

TEST(TriangleMesh, TangentsWithNormalsAreUnitVectorsTurnedByHalfATurn) {
  auto params = oneTriangle();
  params.uv = {{0, 0}, {0.1f, 0}, {0, 0.1f}};
  params.N.assign(3, {0, 0, 1});
  const auto si = hitFromAbove(TriangleMesh(params, {}));
  EXPECT_FLOAT_EQ(si.dpdu.x, 10);
  EXPECT_FLOAT_EQ(si.shading.dpdu.x, -1);
  EXPECT_FLOAT_EQ(si.shading.dpdv.y, -1);
  params.S.assign(3, {0, 3, 0});
  const auto along = hitFromAbove(TriangleMesh(params, {}));
  EXPECT_FLOAT_EQ(along.shading.dpdu.y, -1);
  EXPECT_FLOAT_EQ(along.shading.dpdv.x, 1);
}

TEST(TriangleMesh, IsStoredInWorldSpace) {
  const Transform t = Transform::translate({0, 0, 3}) * Transform::scale(2, 2, 2);
  const TriangleMesh mesh(oneTriangle(), {t, false});
  EXPECT_EQ(mesh.bounds(), (Bounds3f{{0, 0, 3}, {2, 2, 3}}));
  EXPECT_EQ(mesh.area(0), 2);
  EXPECT_EQ(mesh.vertexCount(), 3u);
  EXPECT_EQ(mesh.corners(0)[1], Point3f(2, 0, 3));
  auto params = oneTriangle();
  params.N.assign(3, {0, 1, 1});
  const auto si = hitFromAbove(TriangleMesh(params, {Transform::scale(1, 1, 4), false}));
  EXPECT_LT(length(si.shading.n - normalize(Normal3f(0, 4, 1))), 1e-6f);  // inverse transpose
}

TEST(TriangleMesh, NeverHitsTrianglesWithoutArea) {
  TriangleMesh::Params params;
  params.P = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}};
  params.indices = {0, 1, 2, 0, 0, 1, 3, 4, 5};
  const TriangleMesh mesh(params, {});
  const Probe probe(mesh);
  for (int i = 0; i <= 16; ++i) {
    const auto hit = probe.hit(makeRay({static_cast<float>(i) / 16, 0, 5}, {0, 0, -1}));
    ASSERT_TRUE(hit) << i;
    EXPECT_EQ(hit->id.primitive, 2u);
  }
  EXPECT_EQ(mesh.sample(0, {0.5f, 0.5f}).pdf, 0);
  EXPECT_TRUE(isFinite(mesh.sample(1, {0.5f, 0.5f}).n));
}

TEST(TriangleMesh, KnowsWhetherItIsClosed) {
  auto params = box();
  EXPECT_TRUE(TriangleMesh(params, {}).isClosed());
  auto open = params;
  open.indices.resize(33);
  EXPECT_FALSE(TriangleMesh(open, {}).isClosed());
  EXPECT_FALSE(TriangleMesh(oneTriangle(), {}).isClosed());
  // Every triangle with vertices of its own: equal positions count as one vertex.
  TriangleMesh::Params soup;
  for (const int i : params.indices) {
    soup.indices.push_back(static_cast<int>(soup.P.size()));
    soup.P.push_back(params.P[static_cast<std::size_t>(i)]);
  }
  EXPECT_TRUE(TriangleMesh(soup, {}).isClosed());
  soup.P[0].x = -0.0f;
  EXPECT_TRUE(TriangleMesh(soup, {}).isClosed());
  soup.P[0].x = 1e-3f;
  EXPECT_FALSE(TriangleMesh(soup, {}).isClosed());
  // A wall inside: edges with more than two triangles.
  auto wall = params;
  wall.indices.insert(wall.indices.end(), {0, 3, 7, 0, 7, 4});
  EXPECT_FALSE(TriangleMesh(wall, {}).isClosed());
  // Two boxes that meet in an edge: four triangles there, two of each.
  auto pair = params;
  const auto count = static_cast<int>(params.P.size());
  const Bounds3f bounds = TriangleMesh(params, {}).bounds();
  for (const Point3f& p : params.P)
    pair.P.push_back(p + Vector3f{bounds.diagonal().x, bounds.diagonal().y, 0});
  for (const int i : params.indices) pair.indices.push_back(i + count);
  EXPECT_FALSE(TriangleMesh(pair, {}).isClosed());
}

std::string firstError(TriangleMesh::Params params) {
  for (const auto& problem : TriangleMesh::validate(params)) {
    if (problem.severity == Severity::Error) return problem.parameter + ": " + problem.message;
  }
  return "";
}

TEST(TriangleMesh, ValidationNamesWhatWasFoundAndWhere) {
  EXPECT_EQ(firstError(oneTriangle()), "");
  auto p = oneTriangle();
  p.indices = {0, 1, 3};
  EXPECT_EQ(firstError(p), "indices: indices[2] is 3, expected 0 to 2 for the 3 vertices in P");
  p.indices = {0, -1, 2};
  EXPECT_EQ(firstError(p), "indices: indices[1] is -1, expected 0 to 2 for the 3 vertices in P");
  p.indices = {0, 1};
  EXPECT_EQ(firstError(p), "indices: holds 2 numbers, expected three per triangle");
  p = oneTriangle();
  p.N.resize(2);
  EXPECT_EQ(firstError(p), "N: has 2 elements, expected 3, one per vertex in P");
  p = oneTriangle();
  p.S.resize(4);
  EXPECT_EQ(firstError(p), "S: has 4 elements, expected 3, one per vertex in P");
  p = oneTriangle();
  p.uv.resize(2);
  EXPECT_EQ(firstError(p), "uv: has 2 elements, expected 3, one per vertex in P");
  p = oneTriangle();
  p.faceIndices.resize(2);
  EXPECT_EQ(firstError(p), "faceIndices: has 2 elements, expected 1, one per triangle");
  p = oneTriangle();
  p.P[1].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(firstError(p), "P: P[1] is not a finite number");
  p.P.clear();
  EXPECT_EQ(firstError(p), "P: is missing or empty");
  EXPECT_THROW(TriangleMesh(p, {}), std::invalid_argument);
}

TEST(TriangleMesh, WarnsOfWhatItLeavesOut) {
  auto p = oneTriangle();
  p.indices.push_back(1);
  p.uv.resize(5);
  const auto problems = TriangleMesh::validate(p);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].severity, Severity::Warning);
  EXPECT_EQ(problems[0].parameter, "indices");
  EXPECT_EQ(problems[1].severity, Severity::Warning);
  EXPECT_EQ(problems[1].parameter, "uv");
  const TriangleMesh mesh(p, {});
  EXPECT_EQ(mesh.primitiveCount(), 1u);
}

}  // namespace
}  // namespace pbrtmedia
