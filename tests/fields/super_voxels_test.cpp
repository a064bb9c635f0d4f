// SPDX-License-Identifier: BSD-2-Clause
#include "fields/super_voxels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/rng.h"
#include "fields/grid_field.h"
#include "support/grids.h"

namespace pbrtmedia {
namespace {

using test::constantGrid;
using test::gridOf;
using test::randomGrid;

/// A point of a closed cell, often on its faces, edges and corners, kept inside the field's box.
Vec3d pointOfCell(Rng& rng, Vec3<std::int64_t> cell, double size, const Bounds3d& box) {
  Vec3d p;
  for (std::size_t a = 0; a < 3; ++a) {
    const double u = rng.uniformDouble(), at = u < .2 ? 0 : (u > .8 ? 1 : rng.uniformDouble());
    p[a] = std::clamp((static_cast<double>(cell[a]) + at) * size, box.min[a], box.max[a]);
  }
  return p;
}

class SuperVoxelBounds : public testing::TestWithParam<std::tuple<int, GridBorder, float>> {};

TEST_P(SuperVoxelBounds, HoldInEveryCellIncludingItsFaces) {
  const auto [power, border, emptyShare] = GetParam();
  const GridField field(randomGrid(9, 6, 11, border, emptyShare, 17), Transform());
  const SuperVoxels bounds = field.superVoxels(power);
  const auto n = bounds.shape().count;
  Rng rng(5);
  for (std::int64_t k = 0; k < n.z; ++k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      for (std::int64_t i = 0; i < n.x; ++i) {
        const SuperVoxel bound = bounds.at(i, j, k);
        for (int point = 0; point < 10000; ++point) {
          const float density =
              field.density(pointOfCell(rng, {i, j, k}, bounds.cellSize().x, field.localBox()));
          ASSERT_LE(density, bound.upper) << i << ' ' << j << ' ' << k;
          ASSERT_GE(density, bound.lower) << i << ' ' << j << ' ' << k;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllSizesAndBorders, SuperVoxelBounds,
                         testing::Combine(testing::Values(0, 1, 2, 3),
                                          testing::Values(GridBorder::Zero, GridBorder::Clamp),
                                          testing::Values(0.0f, 0.7f)));

TEST(SuperVoxels, ABoundFromTheOwnSamplesAloneWouldBeViolated) {
  // Negative control of the test above: the samples 4..7 do not bound the cell [4, 8].
  const GridField field(
      gridOf(12, 1, 1, GridBorder::Clamp, [](int i, int, int) { return i == 7 ? 1.0f : 0.0f; }), Transform());
  EXPECT_GT(field.density({7.5, 1, 1}), 0.0f);  // sample 8 of the lattice is voxel 7
  EXPECT_EQ(field.superVoxels(2).at(1, 0, 0).upper, 1.0f + 0x1p-20f + 0x1p-23f);
}

TEST(SuperVoxels, AreExactWhereTheDensityIsConstant) {
  const GridField field(constantGrid(20, GridBorder::Clamp, .3f), Transform());
  const SuperVoxels bounds = field.superVoxels(2);
  for (std::int64_t i = 0; i < bounds.shape().count.x; ++i) {
    EXPECT_EQ(bounds.at(i, 2, 3), (SuperVoxel{.3f, .3f, .3f}));
  }
}

TEST(SuperVoxels, KnowTheirEmptyCellsAndTheBoxAroundTheOthers) {
  const GridField field(
      gridOf(32, 32, 32, GridBorder::Zero,
             [](int i, int j, int k) { return i == 9 && j == 17 && k == 30 ? 2.0f : 0.0f; }),
      Transform());
  const SuperVoxels bounds = field.superVoxels(2);
  // Sample (10, 18, 31) of the lattice: cells of 4 around it.
  EXPECT_EQ(bounds.occupied().min, Vec3d(8, 16, 28));
  EXPECT_EQ(bounds.occupied().max, Vec3d(12, 20, 32));
  EXPECT_EQ(bounds.cellCount() - bounds.emptyCells(), 1u);
  EXPECT_NEAR(bounds.maximum(), 2.0f, 1e-5);
  EXPECT_TRUE(
      GridField(constantGrid(4, GridBorder::Zero, 0), Transform()).superVoxels().occupied().isEmpty());
}

TEST(SuperVoxels, JoinNeighbouringEmptyCellsIntoOneInterval) {
  const GridField field(
      gridOf(64, 1, 1, GridBorder::Zero, [](int i, int, int) { return i == 0 || i == 63 ? 1.0f : 0.0f; }),
      Transform());
  const SuperVoxels bounds = field.superVoxels(0);
  std::vector<float> uppers, means;
  const double infinity = std::numeric_limits<double>::infinity();
  bounds.walk({{.5, 1, 1}, {1, 0, 0}, {1, infinity, infinity}}, 64, [&](double, double, const SuperVoxel& b) {
    uppers.push_back(b.upper);
    means.push_back(b.mean);
    return true;
  });
  // Half a gap and a whole one on either side; one stretch between them.
  ASSERT_EQ(uppers.size(), 5u);
  EXPECT_EQ(uppers[2], 0.0f);
  EXPECT_EQ(means[2], 0.0f);
}

TEST(SuperVoxels, StopWhereTheVisitorHasEnough) {
  const GridField field(constantGrid(32, GridBorder::Clamp), Transform());
  int visits = 0;
  const double infinity = std::numeric_limits<double>::infinity();
  field.superVoxels(0).walk({{.5, 4, 4}, {1, 0, 0}, {1, infinity, infinity}}, 32,
                            [&](double, double, const SuperVoxel&) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

}  // namespace
}  // namespace pbrtmedia
