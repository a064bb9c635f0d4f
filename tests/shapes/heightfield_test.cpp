// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/heightfield.h"

#include <gtest/gtest.h>

#include "shapes/shape_probe.h"

namespace pbrtmedia {
namespace {

TEST(Heightfield, HasItsSamplesAtTheGridPointsWithXAndYAsParameters) {
  const auto params = tessellateHeightfield({.nu = 3, .nv = 2, .Pz = {0, 1, 2, 3, 4, 5}});
  ASSERT_EQ(params.P.size(), 6u);
  EXPECT_EQ(params.P[1], Point3f(0.5f, 0, 1));
  EXPECT_EQ(params.P[3], Point3f(0, 1, 3));
  EXPECT_EQ(params.uv[4], Point2f(0.5f, 1));
  EXPECT_TRUE(params.N.empty());
  EXPECT_TRUE(TriangleMesh::validate(params).empty());
  // z = 2x + 3y: a plane, so every hit is exact.
  const TriangleMesh mesh(params, {});
  EXPECT_EQ(mesh.primitiveCount(), 4u);
  const auto si = test::Probe(mesh).at(test::makeRay({0.3f, 0.7f, 9}, {0, 0, -1}));
  ASSERT_TRUE(si);
  EXPECT_NEAR(si->p.z, 0.6f + 2.1f, 1e-6f);
  EXPECT_NEAR(si->uv.x, 0.3f, 1e-6f);
  EXPECT_NEAR(si->uv.y, 0.7f, 1e-6f);
  EXPECT_GT(si->n.z, 0);
}

TEST(Heightfield, RejectsWrongCounts) {
  EXPECT_THROW(tessellateHeightfield({.nu = 1, .nv = 2, .Pz = {0, 0}}), std::invalid_argument);
  EXPECT_THROW(tessellateHeightfield({.nu = 2, .nv = -2, .Pz = {}}), std::invalid_argument);
  try {
    tessellateHeightfield({.nu = 3, .nv = 2, .Pz = {0, 1, 2}});
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "Pz: expected 6 numbers (nu * nv), found 3");
  }
}

}  // namespace
}  // namespace pbrtmedia
