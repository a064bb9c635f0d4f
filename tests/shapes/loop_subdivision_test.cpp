// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/loop_subdivision.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pbrtmedia {
namespace {

LoopSubdivisionParams octahedron(int levels) {
  return {.levels = levels,
          .indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5},
          .P = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
}

LoopSubdivisionParams tetrahedron(int levels) {
  return {.levels = levels,
          .indices = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2},
          .P = {{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}}};
}

/// An n x n grid of two triangles per cell over [0, 1]² in z = 0, facing +z.
LoopSubdivisionParams grid(int n, int levels) {
  LoopSubdivisionParams p{.levels = levels, .indices = {}, .P = {}};
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) p.P.emplace_back(float(i) / float(n), float(j) / float(n), 0.0f);
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      p.indices.insert(p.indices.end(), {a, b, d, a, d, c});
    }
  }
  return p;
}

TEST(LoopSubdivision, EveryLevelHasFourTimesTheTriangles) {
  for (int levels = 0; levels <= 4; ++levels) {
    const auto mesh = subdivideLoop(octahedron(levels));
    EXPECT_EQ(mesh.indices.size(), 24u << (2 * levels));
    // Euler: V = 2 + F/2 for a closed surface of genus 0.
    EXPECT_EQ(mesh.P.size(), 2 + mesh.indices.size() / 6);
    EXPECT_EQ(mesh.N.size(), mesh.P.size());
    EXPECT_TRUE(mesh.uv.empty());
    EXPECT_TRUE(TriangleMesh::validate(mesh).empty());
    EXPECT_TRUE(TriangleMesh(mesh, {}).isClosed());
  }
}

TEST(LoopSubdivision, LimitPositionsDoNotDependOnTheLevel) {
  // Old vertices come first and keep their numbers; with limit masks they no longer move.
  const auto coarse = subdivideLoop(octahedron(0));
  // Valence 4: beta = 3/32, weight 1/(4 + 3/(8 beta)) = 1/8; the ring of (1,0,0) sums to 0: 1 - 4/8 = 1/2.
  // Vertices are numbered by first use, so compare as sets by the original first corner.
  EXPECT_NEAR(coarse.P[0].x, 0.5f, 1e-6f);
  for (int levels = 1; levels <= 5; ++levels) {
    const auto fine = subdivideLoop(octahedron(levels));
    for (std::size_t i = 0; i < coarse.P.size(); ++i) {
      EXPECT_LT(distance(fine.P[i], coarse.P[i]), 1e-6f) << levels;
      EXPECT_LT(length(fine.N[i] - coarse.N[i]), 1e-5f) << levels;
    }
  }
}

TEST(LoopSubdivision, TetrahedronConvergesToASmoothConvexSurface) {
  // Valence 3: beta = 3/16, weight 1/(3 + 2) = 1/5; the ring of a corner c sums to -c: 1 - 3/5 - 1/5 = 1/5.
  const auto mesh = subdivideLoop(tetrahedron(5));
  EXPECT_LT(distance(mesh.P[0], Point3f(0.2f, 0.2f, 0.2f)), 1e-6f);
  for (std::size_t i = 0; i < mesh.P.size(); ++i) {
    EXPECT_NEAR(length(mesh.N[i]), 1, 1e-5f);
    EXPECT_LT(dot(mesh.N[i], mesh.P[i]), 0);  // inward: against the counter-clockwise faces, as in PBRT-v3
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t k) {
      return Vec3d(mesh.P[static_cast<std::size_t>(mesh.indices[i + k])]);
    };
    const Vec3d face = normalize(cross(p(1) - p(0), p(2) - p(0)));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(dot(face, Vec3d(mesh.N[static_cast<std::size_t>(mesh.indices[i + k])])), -0.95);
    }
  }
}

TEST(LoopSubdivision, APlaneStaysAPlaneWithItsNormal) {
  for (int levels = 0; levels <= 3; ++levels) {
    const auto mesh = subdivideLoop(grid(3, levels));
    for (std::size_t i = 0; i < mesh.P.size(); ++i) {
      EXPECT_EQ(mesh.P[i].z, 0);
      EXPECT_NEAR(mesh.N[i].z, -1, 1e-6f);  // interior, border and corner vertices
    }
  }
}

TEST(LoopSubdivision, BordersAreCubicSplinesOfTheBorderAlone) {
  // Lift the interior vertex of a 2 x 2 grid: the border must not notice.
  auto params = grid(2, 3);
  params.P[4].z = 10;
  const auto lifted = subdivideLoop(params), flat = subdivideLoop(grid(2, 3));
  int border = 0;
  for (std::size_t i = 0; i < flat.P.size(); ++i) {
    if (lifted.P[i].z == 0) ++border;
  }
  EXPECT_EQ(border, 64);  // 8 border edges, 3 times halved
}

TEST(LoopSubdivision, DropsVerticesOfNoTriangle) {
  auto params = octahedron(1);
  params.P.insert(params.P.begin(), Point3f(99, 99, 99));
  for (int& i : params.indices) ++i;
  const auto mesh = subdivideLoop(params);
  EXPECT_EQ(mesh.P, subdivideLoop(octahedron(1)).P);
}

std::string firstError(const LoopSubdivisionParams& params) {
  for (const auto& p : validateLoop(params)) {
    if (p.severity == Severity::Error) return p.parameter + ": " + p.message;
  }
  return "";
}

TEST(LoopSubdivision, RejectsWhatIsNoSurface) {
  EXPECT_EQ(firstError(octahedron(3)), "");
  EXPECT_EQ(firstError(grid(2, 3)), "");
  auto p = octahedron(13);
  EXPECT_EQ(firstError(p), "levels: is 13, expected 0 to 12");
  p.levels = -1;
  EXPECT_EQ(firstError(p), "levels: is -1, expected 0 to 12");
  p = octahedron(1);
  p.indices[4] = 77;
  EXPECT_EQ(firstError(p), "indices: indices[4] is 77, expected 0 to 5 for the 6 vertices in P");
  p = octahedron(1);
  p.indices[1] = p.indices[0];
  EXPECT_EQ(firstError(p), "indices: triangle 0 uses a vertex twice");
  p = octahedron(1);
  std::swap(p.indices[0], p.indices[1]);
  EXPECT_EQ(firstError(p),
            "indices: the edge of vertices 0 and 2 has the same direction in both its triangles; one of them "
            "must be "
            "turned");
  p = octahedron(1);
  p.indices.insert(p.indices.end(), {0, 2, 1});
  EXPECT_EQ(firstError(p), "indices: the edge of vertices 0 and 2 belongs to more than two triangles");
  const LoopSubdivisionParams bowTie{.levels = 1,
                                     .indices = {0, 1, 2, 0, 3, 4},
                                     .P = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}};
  EXPECT_EQ(firstError(bowTie), "indices: the triangles at vertex 0 do not form one fan");
  EXPECT_THROW(subdivideLoop(bowTie), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
