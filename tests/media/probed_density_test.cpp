// SPDX-License-Identifier: BSD-2-Clause
#include "media/probed_density.h"

#include <gtest/gtest.h>

#include <atomic>

namespace pbrtmedia {
namespace {

/// 4 x 2 x 2 cells; the box ends in the middle of the last ones along x.
SuperVoxelLattice lattice() {
  SuperVoxelLattice l;
  l.shape.count = {4, 2, 2};
  l.cellSize = {0.5, 2, 1};
  l.box = {Vec3d(0, 0, 0), Vec3d(1.75, 4, 2)};
  return l;
}

TEST(ProbedDensity, OfAConstantIsTheConstant) {
  const SuperVoxels cells = probedDensity(lattice(), [](Vec3d) { return 3.0f; });
  EXPECT_EQ(cells.at(0, 0, 0), (SuperVoxel{3, 0, 3}));
  EXPECT_EQ(cells.at(3, 1, 1), (SuperVoxel{3, 0, 3}));
  EXPECT_EQ(cells.emptyCells(), 0u);
}

TEST(ProbedDensity, OfARampIsWithinAnOctantOfTheMean) {
  const SuperVoxels cells = probedDensity(lattice(), [](Vec3d p) { return static_cast<float>(10 + p.y); });
  for (const std::int64_t j : {0, 1}) {
    EXPECT_NEAR(cells.at(1, j, 0).mean, 11 + 2 * static_cast<float>(j), 0.5f);
    EXPECT_EQ(cells.at(1, j, 0).mean, cells.at(1, j, 0).upper);
  }
}

TEST(ProbedDensity, LooksAtEveryOctantOfEveryCellInsideTheBox) {
  std::atomic<int> octants[8]{}, outside{0};
  const SuperVoxelLattice l = lattice();
  probedDensity(l, [&](Vec3d p) {
    if (!l.box.contains(p)) ++outside;
    const auto half = [](double x, double size) { return static_cast<std::size_t>(2 * x / size) % 2; };
    ++octants[half(p.x, 0.5) + 2 * half(p.y, 2) + 4 * half(p.z, 1)];
    return 1.0f;
  });
  EXPECT_EQ(outside, 0);
  // What lies beyond the box along x is looked at on its face.
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(octants[i], 16) << i;
}

TEST(ProbedDensity, MissesNothingForGood) {
  // One cell of 16 has all there is: the others get a tenth of the average.
  const SuperVoxels one =
      probedDensity(lattice(), [](Vec3d p) { return p.x < 0.5 && p.y < 2 && p.z < 1 ? 16.0f : 0.0f; });
  EXPECT_EQ(one.at(0, 0, 0).upper, 16);
  EXPECT_FLOAT_EQ(one.at(1, 0, 0).upper, 0.1f);
  EXPECT_FLOAT_EQ(one.at(3, 1, 1).mean, 0.1f);
  const SuperVoxels nothing = probedDensity(lattice(), [](Vec3d) { return 0.0f; });
  EXPECT_EQ(nothing.at(2, 1, 0), (SuperVoxel{1, 0, 1}));
}

}  // namespace
}  // namespace pbrtmedia
