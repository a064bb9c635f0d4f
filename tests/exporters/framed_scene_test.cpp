// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/framed_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "construct/attempt.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

/// Where a point appears, in halves of the picture's sides.
Vec3d onPicture(const Framing& f, Vec3d p) {
  const Vec3d away = normalize(f.look - f.eye), upward = cross(f.right, away), q = p - f.eye;
  const double tangent = std::tan(f.fov * std::numbers::pi / 360), shorter = std::min(f.width, f.height);
  return {dot(q, f.right) / dot(q, away) / tangent * shorter / f.width,
          dot(q, upward) / dot(q, away) / tangent * shorter / f.height, dot(q, away)};
}

TEST(FramedScene, TheCameraSeesTheWholeBoxAndNotMuchElse) {
  const std::vector<Bounds3d> boxes = {{{-1, -1, -1}, {1, 1, 1}},       {{0, 0, 0}, {10, 1, 1}},
                                       {{-1, 0, -1}, {1, 12, 1}},       {{1e5, -2, 3}, {1e5 + 1, 4, 5}},
                                       {{0, 0, 0}, {1e-4, 2e-4, 3e-4}}, {{0, 0, 0}, {5, 5, 0}}};
  for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
    for (const Bounds3d& box : boxes) {
      const Framing f = framed(box, up);
      double widest = 0, highest = 0;
      for (int i = 0; i < 8; ++i) {
        const Vec3d p = onPicture(f, box.corner(i));
        EXPECT_GT(p.z, 0) << "behind the camera";
        widest = std::max(widest, std::abs(p.x));
        highest = std::max(highest, std::abs(p.y));
      }
      EXPECT_LT(std::max(widest, highest), 0.9);
      EXPECT_GT(std::max(widest, highest), 0.7);
      EXPECT_GE(std::min(f.width, f.height), 350);
      EXPECT_EQ(std::max(f.width, f.height), 640);
      EXPECT_GT(dot(f.eye - f.look, f.up), 0) << "from above";
      EXPECT_GT((f.eye - f.look).x, 0) << "from the right";
    }
  }
}

TEST(FramedScene, IsASceneWithoutAWarning) {
  TemporaryFolder folder;
  folder.write("in\"c.pbrt", "");
  for (const bool glows : {false, true}) {
    for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
      const std::string text = framedScene({.source = "a \"b\"\nc.vdb",
                                            .include = "in\"c.pbrt",
                                            .image = "out.exr",
                                            .box = {{10, 20, 30}, {11, 22, 31}},
                                            .up = up,
                                            .glows = glows});
      const test::Attempt a = test::attempt(text, {.folder = folder.path()});
      EXPECT_TRUE(a.isSilent()) << a.messages();
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
