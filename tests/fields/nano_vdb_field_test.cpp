// SPDX-License-Identifier: BSD-2-Clause
#include "fields/nano_vdb_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "fields/field_line.h"
#include "fields/grid_field.h"
#include "fields/nano_vdb_samples.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

using test::Ijk;
using test::NanoVdbCodec;
using test::NanoVdbSample;
using test::NanoVdbStorage;
using test::writeNanoVdb;

/// Values in (0, 1), a third of them 0; the same for the same place.
double noiseAt(Ijk at) {
  std::uint64_t seed = 1;
  for (const int x : at) seed = seed * 1000003u + static_cast<std::uint64_t>(x + 4000);
  Rng rng(seed);
  return rng.uniform() < 0.33f ? 0.0 : rng.uniformDouble();
}

/// Rotated, not uniform, away from the origin.
Transform askew() {
  return Transform::translate({5, -3, 2}) * Transform::rotate(33, {1, 2, -1}) *
         Transform::scale(0.5, 0.25, 0.8);
}

NanoVdbField load(const NanoVdbSample& sample, const Transform& worldFromMedium = {}, DensityMap map = {}) {
  const TemporaryFolder folder;
  writeNanoVdb(folder.path() / "t.nvdb", {sample});
  return NanoVdbField({folder.path() / "t.nvdb", "", map}, worldFromMedium);
}

std::string refusal(const NanoVdbSample& sample, DensityMap map = {}) {
  try {
    load(sample, {}, map);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

Vec3d pointIn(Rng& rng, const Bounds3d& box) {
  const Vec3d d = box.diagonal();
  return box.min + Vec3d(rng.uniformDouble() * d.x, rng.uniformDouble() * d.y, rng.uniformDouble() * d.z);
}

TEST(NanoVdbField, HoldsEachVoxelAtItsWholePointOfIndexSpaceBothEndsIncluded) {
  const NanoVdbField field = load({.min = {-66, -21, -90}, .max = {-50, 4, -63}, .valueAt = noiseAt});
  EXPECT_EQ(field.activeMax().x, -50);
  for (int x = -67; x <= -49; ++x) {
    for (int y = -22; y <= 5; ++y) {
      for (int z = -91; z <= -62; ++z) {
        const bool inside = x >= -66 && x <= -50 && y >= -21 && y <= 4 && z >= -90 && z <= -63;
        ASSERT_EQ(field.densityAt(Vec3d(x, y, z)), inside ? static_cast<float>(noiseAt({x, y, z})) : 0.0f)
            << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(NanoVdbField, AgreesWithNanoVdbsSamplerForEveryStorageAndCodec) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.nvdb";
  for (const NanoVdbStorage storage : {NanoVdbStorage::Float, NanoVdbStorage::Double, NanoVdbStorage::Fp4,
                                       NanoVdbStorage::Fp8, NanoVdbStorage::Fp16, NanoVdbStorage::FpN}) {
    for (const NanoVdbCodec codec : {NanoVdbCodec::None, NanoVdbCodec::Zip, NanoVdbCodec::Blosc}) {
      if (codec == NanoVdbCodec::Blosc && !test::hasBlosc()) continue;
      const NanoVdbSample sample{.storage = storage,
                                 .min = {-66, -21, -40},
                                 .max = {9, 14, 3},
                                 .valueAt = noiseAt,
                                 .worldFromIndex = askew()};
      writeNanoVdb(file, {{.name = "other"}, sample}, codec);
      const NanoVdbField field({file, "density", {}}, Transform());
      Rng rng(11);
      std::vector<Vec3d> points;
      for (int n = 0; n < 1000; ++n) {
        points.push_back(field.worldFromLocal().point(pointIn(rng, field.localBox())));
      }
      const std::vector<double> expected = test::sampledByNanoVdb(file, 1, points);
      ASSERT_EQ(expected.size(), points.size());
      for (std::size_t n = 0; n < points.size(); ++n) {
        ASSERT_NEAR(field.densityAt(points[n]), expected[n], 1e-6)
            << "storage " << static_cast<int>(storage) << ", codec " << static_cast<int>(codec);
      }
    }
  }
}

TEST(NanoVdbField, KeepsQuantisedValuesSmallInMemory) {
  NanoVdbSample sample{.min = {0, 0, 0}, .max = {63, 63, 63}, .valueAt = noiseAt};
  const std::size_t full = load(sample).bytes();
  sample.storage = NanoVdbStorage::Fp4;
  const std::size_t small = load(sample).bytes();
  // 512 bricks of 2048 or 256 bytes, and the same tables in both.
  EXPECT_EQ(full - small, 512u * (2048 - 256));
}

TEST(NanoVdbField, TilesAreTheirDenseCopy) {
  // 40 x 24 x 136 of one value: tiles and part-filled bricks in the first, all samples in the second.
  const NanoVdbField tiles =
      load({.min = {-8, 0, -4}, .max = {31, 23, 131}, .valueAt = [](Ijk) { return 0.75; }});
  GridField::Params dense{.nx = 42,
                          .ny = 26,
                          .nz = 138,
                          .density = {},
                          .p0 = {-9.5f, -1.5f, -5.5f},
                          .p1 = {32.5f, 24.5f, 132.5f}};
  for (int k = 0; k < 138; ++k) {
    for (int j = 0; j < 26; ++j) {
      for (int i = 0; i < 42; ++i) {
        const bool inside = i > 0 && i < 41 && j > 0 && j < 25 && k > 0 && k < 137;
        dense.density.push_back(inside ? 0.75f : 0.0f);
      }
    }
  }
  const GridField grid(dense, Transform());
  Rng rng(2);
  for (int n = 0; n < 20000; ++n) {
    const Vec3d p = pointIn(rng, {{-10, -2, -6}, {33, 25, 133}});
    ASSERT_NEAR(tiles.densityAt(p), grid.densityAt(Point3f(p)), 1e-4) << p;
  }
}

TEST(NanoVdbField, AGridOfTilesOnlyOfEveryLevelIsConstantInside) {
  const NanoVdbField field =
      load({.min = {0, 0, 0}, .max = {255, 127, 127}, .valueAt = [](Ijk) { return 2.0; }});
  EXPECT_LT(field.bytes(), 1000000u);
  Rng rng(2);
  for (int n = 0; n < 1000; ++n) {
    ASSERT_EQ(field.densityAt(pointIn(rng, {{0, 0, 0}, {255, 127, 127}})), 2.0f);
  }
  EXPECT_EQ(field.densityAt({-0.5, 3, 3}), 1.0f);
  EXPECT_EQ(field.densityAt({256, 3, 3}), 0.0f);
}

TEST(NanoVdbField, TheBackgroundCountsInTheBoxGrownByOneVoxelAndNowhereElse) {
  const NanoVdbField field = load({.background = 0.5, .voxels = {{{0, 0, 0}, 4}, {{20, 0, 0}, 4}}});
  EXPECT_EQ(field.densityAt({10, 0.5, 0}), 0.5f);
  EXPECT_EQ(field.densityAt({0.5, 0, 0}), 2.25f);
  EXPECT_EQ(field.densityAt({20.99, 0.99, -0.99}), 0.5f + 3.5f * 1e-2f * 1e-2f * 1e-2f);
  EXPECT_EQ(field.densityAt({21.01, 0, 0}), 0.0f);
  EXPECT_EQ(field.densityAt({10, 1.01, 0}), 0.0f);
}

TEST(NanoVdbField, AnEmptyGridIsClear) {
  for (const double background : {0.0, 3.0}) {
    const NanoVdbField field =
        load({.background = background, .min = {0, 0, 0}, .max = {9, 9, 9}, .valueAt = [=](Ijk) {
                return background;
              }});
    EXPECT_EQ(field.densityAt({0, 0, 0}), 0.0f);
    EXPECT_TRUE(field.superVoxels().occupied().isEmpty());
    EXPECT_NE(field.describe().find("clear"), std::string::npos);
  }
}

TEST(NanoVdbField, OneVoxelIsATentWhoseIntegralIsItsValue) {
  const NanoVdbField field = load({.voxels = {{{-1, -1, -1}, 3}}});
  EXPECT_EQ(field.densityAt({-1, -1, -1}), 3.0f);
  EXPECT_EQ(field.densityAt({-0.5, -1, -1}), 1.5f);
  EXPECT_EQ(field.densityAt({-0.5, -1.5, -1}), 0.75f);
  for (const int power : {0, 1, 3}) {
    const SuperVoxels bounds = field.superVoxels(power);
    double integral = 0;
    for (std::int64_t i = 0; i < bounds.shape().count.x; ++i) {
      for (std::int64_t j = 0; j < bounds.shape().count.y; ++j) {
        for (std::int64_t k = 0; k < bounds.shape().count.z; ++k) {
          double volume = 1;
          const Vec3<std::int64_t> cell(i, j, k);
          for (std::size_t a = 0; a < 3; ++a) {
            const double lo = static_cast<double>(cell[a]) * bounds.cellSize().x,
                         hi = lo + bounds.cellSize().x;
            volume *=
                std::max(0.0, std::min(hi, field.localBox().max[a]) - std::max(lo, field.localBox().min[a]));
          }
          integral += volume * static_cast<double>(bounds.at(i, j, k).mean);
        }
      }
    }
    EXPECT_NEAR(integral, 3, 1e-5) << "power " << power;
  }
}

TEST(NanoVdbField, ReadsTheFarCornerOfMoreThanTwoToTheThirtyOneVoxels) {
  const NanoVdbField field =
      load({.voxels = {{{0, 0, 0}, 1}, {{1299, 1299, 1299}, 2}, {{1290, 5, 1299}, 3}}});
  EXPECT_EQ(field.densityAt({1299, 1299, 1299}), 2.0f);
  EXPECT_EQ(field.densityAt({1290, 5, 1299}), 3.0f);
  EXPECT_EQ(field.densityAt({1299, 1298, 1298}), 0.0f);
  EXPECT_LE(field.superVoxels().cellCount(), std::size_t{1} << 22);
}

TEST(NanoVdbField, FollowsTheFilesTransformThenTheScenes) {
  const Transform scene = Transform::translate({1, 2, 3}) * Transform::scale(-2, 2, 2);
  const NanoVdbField field =
      load({.min = {0, 0, 0}, .max = {9, 9, 9}, .valueAt = noiseAt, .worldFromIndex = askew()}, scene);
  const Vec3d world = scene.point(askew().point(Vec3d(4, 5, 6)));
  EXPECT_NEAR(field.densityAt(world), noiseAt({4, 5, 6}), 1e-6);
}

TEST(NanoVdbField, ScalesAndShiftsItsValues) {
  for (const NanoVdbStorage storage : {NanoVdbStorage::Float, NanoVdbStorage::Fp8}) {
    const NanoVdbField field =
        load({.storage = storage, .min = {0, 0, 0}, .max = {9, 9, 9}, .valueAt = noiseAt}, {},
             {.scale = 4, .offset = 0.5f});
    const double step = storage == NanoVdbStorage::Float ? 1e-6 : 4.0 / 255;
    EXPECT_NEAR(field.densityAt({3, 4, 5}), 4 * noiseAt({3, 4, 5}) + 0.5, step);
    EXPECT_NEAR(field.densityAt({3, 4, -0.999}), 0.5, 0.01);
  }
}

TEST(NanoVdbField, NamesTheVoxelThatIsNoDensity) {
  const auto with = [](double bad) {
    return NanoVdbSample{.min = {-8, 0, 0}, .max = {9, 9, 9}, .valueAt = [=](Ijk at) {
                           return at == Ijk{-3, 4, 5} ? bad : noiseAt(at) + 0.1;
                         }};
  };
  EXPECT_NE(refusal(with(-0.25)).find("grid \"density\": voxel (-3, 4, 5) holds -0.25"), std::string::npos)
      << refusal(with(-0.25));
  EXPECT_NE(refusal(with(std::numeric_limits<double>::quiet_NaN())).find("voxel (-3, 4, 5) holds nan"),
            std::string::npos);
  EXPECT_NE(refusal(with(std::numeric_limits<double>::infinity())).find("voxel (-3, 4, 5) holds inf"),
            std::string::npos);
  EXPECT_NE(refusal(with(0.25), {.offset = -0.3f}).find("holds 0, which gives the density -0.3"),
            std::string::npos)
      << refusal(with(0.25), {.offset = -0.3f});
  NanoVdbSample quantised = with(-0.25);
  quantised.storage = NanoVdbStorage::Fp16;
  EXPECT_NE(refusal(quantised).find("voxel (-3, 4, 5) holds -0.25"), std::string::npos) << refusal(quantised);
  EXPECT_NE(refusal({.background = -1, .voxels = {{{0, 0, 0}, 1}}}).find("the background holds -1"),
            std::string::npos);
  EXPECT_NE(refusal({.min = {0, 0, 0}, .max = {15, 15, 15}, .valueAt = [](Ijk) { return -2.0; }})
                .find("the tile of 8^3 voxels at (0, 0, 0) holds -2"),
            std::string::npos);
  NanoVdbSample levelSet = with(-0.25);
  levelSet.isLevelSet = true;
  EXPECT_NE(refusal(levelSet).find("level set"), std::string::npos);
  EXPECT_EQ(refusal(with(0.25)), "accepted");
}

TEST(NanoVdbField, RefusesWhatCannotBePlacedOrScaled) {
  EXPECT_NE(refusal({}, {.scale = -1}).find("density scale must be finite and >= 0"), std::string::npos);
  EXPECT_NE(refusal({}, {.offset = std::numeric_limits<float>::infinity()}).find("offset must be finite"),
            std::string::npos);
  EXPECT_THROW(load({}, Transform::scale(1, 0, 1)), SceneError);
  const int far = 1 << 30;
  EXPECT_NE(refusal({.voxels = {{{0, 0, 0}, 1}, {{far, far, far}, 1}}}).find("more than 1048576 cubes"),
            std::string::npos);
  const NanoVdbField field = load({});
  EXPECT_THROW(field.superVoxels(-1), SceneError);
  EXPECT_THROW(field.superVoxels(NanoVdbField::kMaxSuperVoxelPower + 1), SceneError);
}

/// A point of a closed cell, often on its faces, edges and corners, kept inside the field's box.
Vec3d pointOfCell(Rng& rng, Vec3<std::int64_t> cell, double size, const Bounds3d& box) {
  Vec3d p;
  for (std::size_t a = 0; a < 3; ++a) {
    const double u = rng.uniformDouble(), at = u < .2 ? 0 : (u > .8 ? 1 : rng.uniformDouble());
    p[a] = std::clamp((static_cast<double>(cell[a]) + at) * size, box.min[a], box.max[a]);
  }
  return p;
}

class NanoVdbBounds : public testing::TestWithParam<std::tuple<int, NanoVdbStorage, double>> {};

TEST_P(NanoVdbBounds, HoldInEveryCellIncludingItsFaces) {
  const auto [power, storage, background] = GetParam();
  const NanoVdbField field = load({.storage = storage,
                                   .background = background,
                                   .min = {-3, 5, -9},
                                   .max = {9, 17, 3},
                                   .valueAt = [](Ijk at) { return at[0] < 0 ? 0.3 : noiseAt(at); }});
  const SuperVoxels bounds = field.superVoxels(power);
  const auto n = bounds.shape().count;
  const std::int64_t points =
      std::max<std::int64_t>(10000, 8000000 / static_cast<std::int64_t>(bounds.cellCount()) / 10);
  Rng rng(5);
  std::int64_t cells = 0;
  for (std::int64_t k = 0; k < n.z; ++k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      for (std::int64_t i = 0; i < n.x; ++i) {
        bool outside = false;
        const Vec3<std::int64_t> cell(i, j, k);
        for (std::size_t a = 0; a < 3; ++a) {
          outside |= static_cast<double>(cell[a] + 1) * bounds.cellSize().x < field.localBox().min[a];
        }
        const SuperVoxel bound = bounds.at(i, j, k);
        if (outside) {
          ASSERT_EQ(bound, (SuperVoxel{0, 0, 0}));
          continue;
        }
        ++cells;
        ASSERT_GE(bound.mean, bound.lower);
        ASSERT_LE(bound.mean, bound.upper);
        ASSERT_EQ(bound.mean == 0, bound.upper == 0);
        for (std::int64_t point = 0; point < (power == 0 ? 200 : points); ++point) {
          const float density = field.density(pointOfCell(rng, cell, bounds.cellSize().x, field.localBox()));
          ASSERT_LE(density, bound.upper) << i << ' ' << j << ' ' << k;
          ASSERT_GE(density, bound.lower) << i << ' ' << j << ' ' << k;
        }
      }
    }
  }
  EXPECT_GE(cells, 1);
}

INSTANTIATE_TEST_SUITE_P(AllSizesAndStorages, NanoVdbBounds,
                         testing::Combine(testing::Values(0, 2, 3, 4),
                                          testing::Values(NanoVdbStorage::Float, NanoVdbStorage::Fp4),
                                          testing::Values(0.0, 0.125)));

TEST(NanoVdbBounds, ABoundFromTheBricksOwnVoxelsAloneWouldBeViolated) {
  // Negative control: voxel 8 begins the next brick, yet reaches over the face into this one.
  const NanoVdbField field = load({.voxels = {{{0, 0, 0}, 0.25}, {{8, 0, 0}, 1}}});
  const Vec3d local = field.localFromWorld().point({7.75, 0, 0});
  EXPECT_EQ(field.density(local), 0.75f);
  const auto cell = [](double x) { return static_cast<std::int64_t>(x / 8); };
  EXPECT_GE(field.superVoxels(3).at(cell(local.x), cell(local.y), cell(local.z)).upper, 1.0f);
}

TEST(NanoVdbField, PiecesAreCubicsThatJoin) {
  const NanoVdbField field =
      load({.min = {-20, -9, -9}, .max = {20, 9, 9}, .valueAt = noiseAt, .worldFromIndex = askew()});
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels());
  Rng rng(8);
  int lines = 0;
  for (int n = 0; n < 40; ++n) {
    const Vec3d a = field.worldFromLocal().point(pointIn(rng, field.localBox())),
                b = field.worldFromLocal().point(pointIn(rng, field.localBox()));
    const auto line = FieldLine<NanoVdbField>::clip(field, bounds, {Point3f(a), Vector3f(b - a), 0, 1});
    if (!line) continue;
    ++lines;
    double integral = 0, reached = -1;
    line->walkPieces([&](double begin, double end) {
      if (reached >= 0) {
        EXPECT_GE(begin, reached);
      }
      reached = end;
      // Simpson's rule is exact for cubics; the ends are drawn in a little, which costs less than 1e-6.
      const auto at = [&](double u) { return static_cast<double>(line->density(begin + u * (end - begin))); };
      integral += (end - begin) / 6 * (at(1e-7) + 4 * at(0.5) + at(1 - 1e-7));
      return true;
    });
    constexpr int kSteps = 200000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      sum += static_cast<double>(line->density((i + 0.5) / kSteps * line->length()));
    EXPECT_NEAR(integral, sum / kSteps * line->length(), 2e-5);
  }
  EXPECT_GT(lines, 30);
}

}  // namespace
}  // namespace pbrtmedia
