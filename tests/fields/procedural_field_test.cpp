// SPDX-License-Identifier: BSD-2-Clause
#include "fields/procedural_field.h"

#include <gtest/gtest.h>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "fields/analytic_density.h"
#include "fields/perlin_density.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20241127;

ProceduralField field(std::shared_ptr<const DensityFunction> function, Point3f p0, Point3f p1,
                      const Transform& place = Transform()) {
  return ProceduralField({.function = std::move(function), .p0 = p0, .p1 = p1, .cells = {7, 5, 6}}, place);
}

TEST(ProceduralField, IsItsFunctionWhereverItIsPlaced) {
  const std::shared_ptr<const DensityFunction> ramp = makeAnalyticDensity(Ramp{.from = -2, .to = 3});
  const Transform place = Transform::translate(Vec3d(5, 0, -1e4)) * Transform::scale(2, -1, 4);
  const auto placed = field(ramp, {1, 1, 3}, {-1, 0, -2}, place);
  Rng rng(kSeed);
  for (int n = 0; n < 1000; ++n) {
    const Vec3d medium(2 * rng.uniformDouble() - 1, rng.uniformDouble(), 5 * rng.uniformDouble() - 2);
    const Point3f world(place.point(medium));
    EXPECT_NEAR(double{placed.densityAt(world)}, double{ramp->at(medium)}, 1e-3);
  }
  EXPECT_EQ(placed.densityAt({0, 0, 0}), 0.0f);
}

TEST(ProceduralField, HasBoundsThatHoldOnFacesAndInside) {
  PerlinDensity::Params perlin;
  perlin.octaves = 5;
  perlin.frequency = 2;
  for (const std::shared_ptr<const DensityFunction>& function :
       {std::shared_ptr<const DensityFunction>(std::make_shared<PerlinDensity>(perlin)),
        std::shared_ptr<const DensityFunction>(makeAnalyticDensity(SineSphere{})),
        std::shared_ptr<const DensityFunction>(makeAnalyticDensity(Needle{}))}) {
    const auto procedural = field(function, {-1, -1, 0}, {1, 1, 2});
    const std::optional<SuperVoxels> bounds = procedural.superVoxels();
    ASSERT_TRUE(bounds);
    Rng rng(kSeed);
    const auto& count = bounds->shape().count;
    for (std::int64_t k = 0; k < count.z; ++k) {
      for (std::int64_t j = 0; j < count.y; ++j) {
        for (std::int64_t i = 0; i < count.x; ++i) {
          const SuperVoxel bound = bounds->at(i, j, k);
          ASSERT_TRUE(bound.hasMean());
          for (int n = 0; n < 200; ++n) {
            const auto pick = [&](std::int64_t at) {
              const double u = rng.uniformDouble();
              return static_cast<double>(at) + (n % 3 == 0 ? std::round(u) : u);
            };
            const float d = procedural.density({pick(i), pick(j), pick(k)});
            ASSERT_LE(d, bound.upper);
            ASSERT_GE(d, bound.lower);
          }
        }
      }
    }
  }
}

TEST(ProceduralField, EmptyCellsOfABallAreKnown) {
  const auto ball = field(makeAnalyticDensity(Ball{.radius = .2}), {-1, -1, -1}, {1, 1, 1});
  const std::optional<SuperVoxels> bounds = ball.superVoxels();
  EXPECT_GT(bounds->emptyCells(), bounds->cellCount() / 2);
  EXPECT_LT(bounds->emptyCells(), bounds->cellCount());
}

TEST(ProceduralField, RefusesABadBoxOrLattice) {
  const std::shared_ptr<const DensityFunction> ramp = makeAnalyticDensity(Ramp{});
  EXPECT_THROW(field(ramp, {0, 0, 0}, {1, 0, 1}), SceneError);
  EXPECT_THROW(ProceduralField({.function = ramp, .cells = {0, 1, 1}}, Transform()), SceneError);
  EXPECT_THROW(ProceduralField({.function = ramp, .cells = {1, 1, 4096}}, Transform()), SceneError);
}

}  // namespace
}  // namespace pbrtmedia
