// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fields/constant_field.h"
#include "support/grids.h"

namespace pbrtmedia {
namespace {

using test::constantGrid;
using test::gridOf;
using test::randomGrid;

/// Integral over a box that lies in one lattice gap: two-point Gauss-Legendre per axis is exact there.
double integralOverGap(const GridField& field, const Bounds3d& box) {
  constexpr double kGauss = 0.57735026918962576451;  // 1/sqrt(3)
  const Vec3d half = box.diagonal() * 0.5, middle = box.centre();
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = [&](int bit) { return corner >> bit & 1 ? kGauss : -kGauss; };
    sum += static_cast<double>(
        field.density({middle.x + at(0) * half.x, middle.y + at(1) * half.y, middle.z + at(2) * half.z}));
  }
  return sum * half.x * half.y * half.z;
}

/// Mean density over the part of a cell inside the field's box, gap by gap.
double meanByQuadrature(const GridField& field, Vec3<std::int64_t> cell, std::int64_t size) {
  const Bounds3d box = field.localBox();
  double integral = 0, volume = 0;
  const auto end = [&](std::int64_t c, int n) { return std::min((c + 1) * size, n + std::int64_t{1}); };
  for (std::int64_t k = cell.z * size; k < end(cell.z, field.nz()); ++k) {
    for (std::int64_t j = cell.y * size; j < end(cell.y, field.ny()); ++j) {
      for (std::int64_t i = cell.x * size; i < end(cell.x, field.nx()); ++i) {
        const Vec3d low(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const Bounds3d part{max(box.min, low), min(box.max, low + Vec3d(1, 1, 1))};
        if (part.isEmpty()) continue;
        const Vec3d d = part.diagonal();
        volume += d.x * d.y * d.z;
        integral += integralOverGap(field, part);
      }
    }
  }
  return integral / volume;
}

template <class Check>
void eachCell(const SuperVoxels& bounds, Check&& check) {
  const auto n = bounds.shape().count;
  for (std::int64_t k = 0; k < n.z; ++k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      for (std::int64_t i = 0; i < n.x; ++i) check(Vec3<std::int64_t>(i, j, k), bounds.at(i, j, k));
    }
  }
}

using Shape = std::tuple<int, int, int>;
class SuperVoxelMean
    : public testing::TestWithParam<std::tuple<int, GridBorder, Shape, GridPrecision, GridLayout>> {};

TEST_P(SuperVoxelMean, IsTheIntegralOverThePartInsideTheBox) {
  const auto [power, border, shape, precision, layout] = GetParam();
  auto params = randomGrid(std::get<0>(shape), std::get<1>(shape), std::get<2>(shape), border, .4f, 17);
  params.precision = precision;
  params.layout = layout;
  const GridField field(params, Transform());
  const SuperVoxels bounds = field.superVoxels(power);
  const std::int64_t edge = std::int64_t{1} << power;
  eachCell(bounds, [&](Vec3<std::int64_t> cell, const SuperVoxel& bound) {
    const double truth = meanByQuadrature(field, cell, edge);
    EXPECT_NEAR(static_cast<double>(bound.mean), truth, 4e-7 * static_cast<double>(bound.upper))
        << cell.x << ' ' << cell.y << ' ' << cell.z;
    EXPECT_EQ(bound.mean > 0, bound.upper > 0);
    EXPECT_LE(bound.mean, bound.upper);
    EXPECT_GE(bound.mean, bound.lower);
    EXPECT_TRUE(bound.hasMean());
  });
}

INSTANTIATE_TEST_SUITE_P(SizesBordersShapesAndStorage, SuperVoxelMean,
                         testing::Combine(testing::Values(0, 1, 2, 3, 10),
                                          testing::Values(GridBorder::Zero, GridBorder::Clamp),
                                          testing::Values(Shape(9, 6, 11), Shape(1, 1, 1), Shape(8, 15, 2)),
                                          testing::Values(GridPrecision::Float, GridPrecision::Half),
                                          testing::Values(GridLayout::Linear, GridLayout::Bricked)));

TEST(SuperVoxelMeans, AddUpToTheIntegralOfTheField) {
  // Under the clamp border each sample stands for its whole voxel, so the integral is the sum of the samples.
  const auto params = randomGrid(13, 7, 10, GridBorder::Clamp, .3f, 3);
  double truth = 0;
  for (const float v : params.density) truth += static_cast<double>(v);
  const GridField field(params, Transform());
  for (const int power : {0, 1, 2, 3, 4}) {
    const SuperVoxels bounds = field.superVoxels(power);
    const Bounds3d box = field.localBox();
    double sum = 0;
    eachCell(bounds, [&](Vec3<std::int64_t> cell, const SuperVoxel& bound) {
      const double size = bounds.cellSize().x;
      const Vec3d low = Vec3d(cell) * size;
      const Vec3d d = min(box.max, low + Vec3d(size, size, size)) - max(box.min, low);
      sum += d.x * d.y * d.z * static_cast<double>(bound.mean);
    });
    EXPECT_NEAR(sum / truth, 1, 1e-6) << power;
  }
}

TEST(SuperVoxelMeans, OfOneSampleUnderTheZeroBorder) {
  // Over [1/2, 3/2] the hat function of the sample has the mean 3/4 per axis.
  const GridField field(constantGrid(1, GridBorder::Zero, 2), Transform());
  EXPECT_FLOAT_EQ(field.superVoxels(3).at(0, 0, 0).mean, 2 * .75f * .75f * .75f);
}

TEST(SuperVoxelMeans, StayPositiveWhereFloatCannotHoldThem) {
  constexpr float kMin = std::numeric_limits<float>::denorm_min();
  const GridField field(gridOf(16, 16, 16, GridBorder::Zero,
                               [](int i, int j, int k) { return i == 8 && j == 8 && k == 8 ? kMin : 0.0f; }),
                        Transform());
  const SuperVoxels bounds = field.superVoxels(4);
  EXPECT_EQ(bounds.at(0, 0, 0).mean, kMin);
  EXPECT_EQ(bounds.at(1, 0, 0).mean, 0.0f);
  EXPECT_EQ(bounds.at(1, 0, 0).upper, 0.0f);
}

TEST(SuperVoxelMeans, OfTheLargestFloatsStayFinite) {
  constexpr float kMax = std::numeric_limits<float>::max();
  for (const GridPrecision precision : {GridPrecision::Float, GridPrecision::Half}) {
    auto params = constantGrid(6, GridBorder::Zero, kMax);
    params.precision = precision;
    const GridField field(params, Transform());
    eachCell(field.superVoxels(1), [](Vec3<std::int64_t>, const SuperVoxel& bound) {
      EXPECT_TRUE(std::isfinite(bound.mean));
      EXPECT_TRUE(std::isfinite(bound.upper));
      EXPECT_LE(bound.mean, bound.upper);
    });
  }
}

TEST(SuperVoxelMeans, OfAConstantFieldAreItsDensity) {
  EXPECT_EQ(ConstantField({2.5f}, Transform()).superVoxels().at(0, 0, 0), (SuperVoxel{2.5f, 2.5f, 2.5f}));
}

}  // namespace
}  // namespace pbrtmedia
