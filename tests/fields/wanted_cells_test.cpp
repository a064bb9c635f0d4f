// SPDX-License-Identifier: BSD-2-Clause
// Super-voxels of a number that somebody asks for, on every field.
#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "fields/analytic_density.h"
#include "fields/constant_field.h"
#include "fields/field_line.h"
#include "fields/grid_field.h"
#include "fields/procedural_field.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20250102;

/// Every density of every cell lies within its bounds, on faces too.
template <class Field>
void expectBounds(const Field& field, const SuperVoxels& bounds) {
  Rng rng(kSeed);
  const Vec3d size = bounds.cellSize();
  const Bounds3d box = field.localBox();
  const auto& count = bounds.shape().count;
  for (std::int64_t k = 0; k < count.z; ++k) {
    for (std::int64_t j = 0; j < count.y; ++j) {
      for (std::int64_t i = 0; i < count.x; ++i) {
        const SuperVoxel bound = bounds.at(i, j, k);
        for (int n = 0; n < 50; ++n) {
          Vec3d p;
          for (std::size_t a = 0; a < 3; ++a) {
            const double u = rng.uniformDouble();
            const auto cell = static_cast<double>(a == 0 ? i : a == 1 ? j : k);
            p[a] = std::clamp((cell + (n % 3 == 0 ? std::round(u) : u)) * size[a], box.min[a], box.max[a]);
          }
          ASSERT_LE(field.density(p), bound.upper);
          ASSERT_GE(field.density(p), bound.lower);
          if (n % 3 != 0) {
            ASSERT_EQ(bounds.upperOf(bounds.cellAt(p)), bound.upper);
          }
        }
      }
    }
  }
}

TEST(WantedCells, OfGridsHoldWholeVoxelsAndBound) {
  GridField::Params params{.nx = 13, .ny = 7, .nz = 30, .density = {}};
  Rng rng(kSeed);
  for (int n = 0; n < 13 * 7 * 30; ++n) params.density.push_back(rng.uniform() < .5f ? 0 : rng.uniform());
  const GridField field(params, Transform());
  for (const auto& [wanted, expected] : {std::pair(std::array{0, 0, 0}, Vec3<std::int64_t>(1, 1, 1)),
                                         {{1, 2, 3}, {1, 2, 3}},
                                         {{5, 5, 5}, {5, 4, 5}},
                                         {{100, 100, 100}, {14, 8, 31}}}) {
    const SuperVoxels bounds = field.superVoxels(field.lattice(wanted));
    EXPECT_EQ(bounds.shape().count, expected);
    expectBounds(field, bounds);
  }
  EXPECT_EQ(field.lattice({}).cellSize, Vec3d(4, 4, 4));
}

TEST(WantedCells, OfFunctionsAreAsManyAsAsked) {
  const std::shared_ptr<const DensityFunction> function = makeAnalyticDensity(SineSphere{});
  const ProceduralField field(
      {.function = function, .p0 = {-10, -10, 0}, .p1 = {10, 10, 20}, .cells = {8, 8, 8}}, Transform());
  for (const std::array<int, 3> wanted : {std::array{0, 0, 0}, {1, 7, 20}, {9, 8, 3}}) {
    const std::optional<SuperVoxels> bounds = field.superVoxels(field.lattice(wanted));
    EXPECT_EQ(bounds->shape().count,
              (Vec3<std::int64_t>(std::max(1, wanted[0]), std::max(1, wanted[1]), std::max(1, wanted[2]))));
    expectBounds(field, *bounds);
  }
  EXPECT_EQ(field.lattice({}).shape.count, (Vec3<std::int64_t>(8, 8, 8)));
}

TEST(WantedCells, OfUnequalEdgesAreWalkedWithoutGaps) {
  const SuperVoxelLattice lattice{LatticeShape{{3, 4, 5}}, {2, .5, 1.25}, {{0, 0, 0}, {6, 2, 6.25}}};
  const SuperVoxels bounds(lattice, [](std::int64_t i, std::int64_t j, std::int64_t k) {
    return SuperVoxel{static_cast<float>(1 + i + 10 * j + 100 * k), 0, 1};
  });
  EXPECT_EQ(bounds.occupied(), lattice.box);
  Rng rng(kSeed);
  for (int n = 0; n < 200; ++n) {
    const auto inside = [&] {
      return Vec3d(6 * rng.uniformDouble(), 2 * rng.uniformDouble(), 6.25 * rng.uniformDouble());
    };
    const Vec3d a = inside(), d = inside() - a;
    double reached = 0;
    bounds.walk({a, d, {1 / d.x, 1 / d.y, 1 / d.z}}, 1,
                [&](double enter, double exit, const SuperVoxel& bound) {
                  EXPECT_EQ(enter, reached);
                  EXPECT_EQ(bounds.upperOf(bounds.cellAt(a + (enter + exit) / 2 * d)), bound.upper);
                  reached = exit;
                  return true;
                });
    EXPECT_EQ(reached, 1.0);
  }
}

TEST(WantedCells, LeaveNoSliverBehindTheLastFace) {
  const ConstantField field({.density = 3}, Transform());
  const FieldBounds bounds = FieldBounds::given(SuperVoxels(
      {LatticeShape{{32, 32, 32}}, Vec3d(1, 1, 1) / 32., {{0, 0, 0}, {1, 1, 1}}}, SuperVoxel{2, 0, -1}));
  Rng rng(kSeed);
  int lines = 0;
  for (int n = 0; n < 20000; ++n) {
    const Point3f o(4 * rng.uniform() - 1.5f, 4 * rng.uniform() - 1.5f, -2);
    const Point3f to(rng.uniform(), rng.uniform(), rng.uniform());
    const auto line = FieldLine<ConstantField>::clip(field, bounds, {o, to - o, 0, 9});
    if (!line) continue;
    ++lines;
    double reached = 0;
    line->walk([&](double enter, double exit, const SuperVoxel& bound) {
      EXPECT_EQ(enter, reached);
      EXPECT_EQ(bound.upper, 2.0f) << "at " << enter << " of " << line->length();
      reached = exit;
      return true;
    });
    EXPECT_EQ(reached, line->length());
  }
  EXPECT_GT(lines, 10000);
}

}  // namespace
}  // namespace pbrtmedia
