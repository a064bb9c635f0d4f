// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_field.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "fields/constant_field.h"
#include "support/grids.h"

namespace pbrtmedia {
namespace {

using test::constantGrid;
using test::gridOf;
using test::randomGrid;

std::string refusal(const GridField::Params& params, const Transform& worldFromMedium = {}) {
  try {
    GridField field(params, worldFromMedium);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(GridField, HoldsEachSampleAtItsVoxelsCentreWithXFastest) {
  const auto params = gridOf(2, 3, 4, GridBorder::Zero, [](int i, int j, int k) {
    return static_cast<float>(1 + i + 10 * j + 100 * k);
  });
  ASSERT_EQ(params.density[1], 2.0f);  // the next value in the file is the next x
  const GridField field(params, Transform());
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 2; ++i) {
        const Point3f centre((i + .5f) / 2, (j + .5f) / 3, (k + .5f) / 4);
        EXPECT_NEAR(field.densityAt(centre), 1 + i + 10 * j + 100 * k, 1e-4) << centre;
      }
    }
  }
}

TEST(GridField, InterpolatesLinearFunctionsExactlyBetweenCentres) {
  const auto params = gridOf(5, 6, 7, GridBorder::Clamp, [](int i, int j, int k) {
    return static_cast<float>(1 + 2 * i + 3 * j + 5 * k);
  });
  const GridField field(params, Transform());
  Rng rng(1);
  for (int n = 0; n < 1000; ++n) {
    const double i = 4 * rng.uniformDouble(), j = 5 * rng.uniformDouble(), k = 6 * rng.uniformDouble();
    EXPECT_NEAR(field.density({i + 1, j + 1, k + 1}), 1 + 2 * i + 3 * j + 5 * k, 1e-5 * 60);
  }
}

TEST(GridField, FadesOverTheOuterHalfVoxelUnderTheZeroBorder) {
  const GridField field(constantGrid(1, GridBorder::Zero), Transform());
  EXPECT_EQ(field.densityAt({.5f, .5f, .5f}), 1.0f);
  EXPECT_EQ(field.densityAt({.25f, .5f, .5f}), .75f);
  EXPECT_EQ(field.densityAt({0, .5f, .5f}), .5f);
  EXPECT_EQ(field.densityAt({0, 0, 1}), .125f);
  EXPECT_EQ(field.densityAt({-1e-3f, .5f, .5f}), 0.0f);
}

TEST(GridField, HoldsTheEdgeValueUnderTheClampBorderAndNothingOutside) {
  const GridField field(constantGrid(3, GridBorder::Clamp, 2.5f), Transform());
  Rng rng(2);
  for (int n = 0; n < 1000; ++n) {
    EXPECT_EQ(field.densityAt({rng.uniform(), rng.uniform(), rng.uniform()}), 2.5f);
  }
  EXPECT_EQ(field.densityAt({0, 0, 0}), 2.5f);
  EXPECT_EQ(field.densityAt({1, 1, 1}), 2.5f);
  EXPECT_EQ(field.densityAt({1.0001f, .5f, .5f}), 0.0f);
}

TEST(GridField, FollowsItsTransformAndItsBox) {
  auto params = randomGrid(4, 4, 4, GridBorder::Zero, .2f, 3);
  const GridField plain(params, Transform());
  params.p0 = {-1, 2, 3};
  params.p1 = {3, 4, 11};
  const Transform place = Transform::translate({10, 20, 30}) * Transform::rotate(30, {1, 2, 3});
  const GridField placed(params, place);
  Rng rng(4);
  for (int n = 0; n < 1000; ++n) {
    const Point3f u(rng.uniform(), rng.uniform(), rng.uniform());
    const Point3f world = place.point(Point3f(-1 + 4 * u.x, 2 + 2 * u.y, 3 + 8 * u.z));
    EXPECT_NEAR(placed.densityAt(world), plain.densityAt(u), 1e-4);
  }
}

TEST(GridField, MirrorsItsDataWhenTheCornersAreSwapped) {
  auto params = gridOf(2, 1, 1, GridBorder::Clamp, [](int i, int, int) { return i == 0 ? 1.0f : 3.0f; });
  params.p0 = {1, 0, 0};
  params.p1 = {0, 1, 1};
  const GridField field(params, Transform());
  EXPECT_EQ(field.densityAt({.1f, .5f, .5f}), 3.0f);
  EXPECT_EQ(field.densityAt({.9f, .5f, .5f}), 1.0f);
}

TEST(GridField, NamesTheVoxelThatIsNotADensity) {
  for (const float bad :
       {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    auto params = constantGrid(5, GridBorder::Zero);
    params.density[static_cast<std::size_t>((3 * 5 + 1) * 5 + 2)] = bad;
    EXPECT_NE(refusal(params).find("voxel (2, 1, 3)"), std::string::npos) << refusal(params);
  }
}

TEST(GridField, RefusesWrongCountsShapesAndBoxes) {
  auto params = constantGrid(3, GridBorder::Zero);
  params.density.pop_back();
  EXPECT_NE(refusal(params).find("3 * 3 * 3 = 27 values; found 26"), std::string::npos) << refusal(params);
  params = constantGrid(3, GridBorder::Zero);
  params.ny = 0;
  EXPECT_NE(refusal(params).find("at least 1; found 3, 0, 3"), std::string::npos) << refusal(params);
  params = constantGrid(3, GridBorder::Zero);
  params.nx = params.ny = params.nz = std::numeric_limits<int>::max();
  EXPECT_NE(refusal(params).find("found 27"), std::string::npos) << refusal(params);
  params = constantGrid(3, GridBorder::Zero);
  params.p1.y = params.p0.y;
  EXPECT_NE(refusal(params).find("differ on every axis"), std::string::npos) << refusal(params);
  params = constantGrid(3, GridBorder::Zero);
  params.p1.y = std::numeric_limits<float>::infinity();
  EXPECT_NE(refusal(params).find("finite"), std::string::npos) << refusal(params);
  EXPECT_NE(refusal(constantGrid(3, GridBorder::Zero), Transform::scale(1, 0, 1)).find("no inverse"),
            std::string::npos);
  EXPECT_EQ(refusal(constantGrid(3, GridBorder::Zero)), "accepted");
}

TEST(GridField, RefusesSuperVoxelsOfImpossibleSize) {
  const GridField field(constantGrid(3, GridBorder::Zero), Transform());
  EXPECT_THROW(field.superVoxels(-1), SceneError);
  EXPECT_THROW(field.superVoxels(GridField::kMaxSuperVoxelPower + 1), SceneError);
  EXPECT_EQ(field.superVoxels(GridField::kMaxSuperVoxelPower).cellCount(), 1u);
}

TEST(ConstantField, IsItsDensityInsideTheBoxOnly) {
  const ConstantField field({2.0f, {1, 1, 1}, {3, 2, 0}}, Transform::translate({0, 0, 5}));
  EXPECT_EQ(field.densityAt({2, 1.5f, 5.5f}), 2.0f);
  EXPECT_EQ(field.densityAt({2, 1.5f, 6.5f}), 0.0f);
  EXPECT_EQ(field.superVoxels().at(0, 0, 0), (SuperVoxel{2, 2, 2}));
}

TEST(ConstantField, RefusesWhatIsNoDensity) {
  EXPECT_THROW(ConstantField({-1}, Transform()), SceneError);
  EXPECT_THROW(ConstantField({std::numeric_limits<float>::quiet_NaN()}, Transform()), SceneError);
  EXPECT_THROW(ConstantField({1, {0, 0, 0}, {0, 1, 1}}, Transform()), SceneError);
}

}  // namespace
}  // namespace pbrtmedia
