// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/nurbs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pbrtmedia {
namespace {

/// A quarter of a cylinder of radius 1 around z, height 2: a rational arc in u, a line in v.
NurbsParams quarterCylinder() {
  NurbsParams p{
      .nu = 3, .nv = 2, .uorder = 3, .vorder = 2, .uknots = {0, 0, 0, 1, 1, 1}, .vknots = {0, 0, 1, 1}};
  const float w = std::sqrt(0.5f);
  for (const float z : {0.0f, 2.0f}) {
    for (const auto& [x, y, weight] : {std::array{1.0f, 0.0f, 1.0f}, {1.0f, 1.0f, w}, {0.0f, 1.0f, 1.0f}}) {
      p.Pw.insert(p.Pw.end(), {x * weight, y * weight, z * weight, weight});
    }
  }
  return p;
}

TEST(Nurbs, RationalPatchesAreExact) {
  const auto mesh = tessellateNurbs(quarterCylinder());
  ASSERT_EQ(mesh.P.size(), 900u);
  EXPECT_TRUE(TriangleMesh::validate(mesh).empty());
  for (std::size_t i = 0; i < mesh.P.size(); ++i) {
    const Point3f& p = mesh.P[i];
    EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-6f);
    EXPECT_NEAR(p.z, 2 * mesh.uv[i].y, 1e-6f);
    EXPECT_LT(length(mesh.N[i] - Normal3f(p.x, p.y, 0)), 1e-5f);  // dp/du x dp/dv is outward
  }
  EXPECT_EQ(mesh.uv.front(), Point2f(0, 0));
  EXPECT_EQ(mesh.uv.back(), Point2f(1, 1));
}

TEST(Nurbs, UniformKnotsUseTheValidRangeAndParametersAreNotNormalised) {
  // Control points on the plane z = x + y at the Greville abscissae: the patch reproduces the plane linearly.
  NurbsParams p{.nu = 5,
                .nv = 4,
                .uorder = 4,
                .vorder = 3,
                .uknots = {0, 1, 2, 3, 4, 5, 6, 7, 8},
                .vknots = {0, 1, 2, 3, 4, 5, 6}};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 5; ++i) {
      const float u = static_cast<float>(i) + 2, v = static_cast<float>(j) + 1.5f;
      p.P.emplace_back(u, v, u + v);
    }
  }
  const auto mesh = tessellateNurbs(p);
  EXPECT_EQ(mesh.uv.front(), Point2f(3, 2));
  EXPECT_EQ(mesh.uv.back(), Point2f(5, 4));
  for (std::size_t i = 0; i < mesh.P.size(); ++i) {
    EXPECT_NEAR(mesh.P[i].x, mesh.uv[i].x, 1e-5f);
    EXPECT_NEAR(mesh.P[i].y, mesh.uv[i].y, 1e-5f);
    EXPECT_LT(length(mesh.N[i] - normalize(Normal3f(-1, -1, 1))), 1e-5f);
  }
  p.u0 = 3.5f;
  p.u1 = 4.0f;
  EXPECT_EQ(tessellateNurbs(p).uv.front(), Point2f(3.5f, 2));
}

TEST(Nurbs, RejectsBadParametersByName) {
  const auto message = [](auto change) -> std::string {
    NurbsParams p = quarterCylinder();
    change(p);
    try {
      tessellateNurbs(p);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message([](NurbsParams&) {}), "");
  EXPECT_EQ(message([](NurbsParams& p) { p.uorder = 1; }),
            "uorder: expected at least 2 (degree + 1), found 1");
  EXPECT_EQ(message([](NurbsParams& p) { p.nv = 1; }),
            "nv: expected at least as many control points as vorder, found 1");
  EXPECT_EQ(message([](NurbsParams& p) { p.uknots.pop_back(); }),
            "uknots: expected 6 numbers (nu + uorder), found 5");
  EXPECT_EQ(message([](NurbsParams& p) { p.uknots[4] = 0.5f; }),
            "uknots[4]: expected a finite number not below its predecessor, found 0.5");
  EXPECT_EQ(message([](NurbsParams& p) { p.Pw.pop_back(); }),
            "Pw: expected 24 numbers (4 * nu * nv), found 23");
  EXPECT_NE(message([](NurbsParams& p) { p.u0 = -1; }), "");
  EXPECT_NE(message([](NurbsParams& p) { p.u1 = 0; }), "");
  EXPECT_NE(message([](NurbsParams& p) { p.Pw.assign(24, 0); }), "");
}

}  // namespace
}  // namespace pbrtmedia
