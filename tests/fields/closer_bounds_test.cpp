// SPDX-License-Identifier: BSD-2-Clause
#include "fields/closer_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "fields/field_line.h"
#include "fields/grid_field.h"
#include "fields/perlin_density.h"
#include "fields/procedural_field.h"
#include "support/grids.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20261129;

ProceduralField perlin() {
  return ProceduralField(
      {.function = std::make_shared<PerlinDensity>(PerlinDensity::Params{}), .cells = {6, 6, 6}},
      Transform());
}

/// What the refined walk of a line says, checked: consecutive stretches from 0 to the end, whose bounds hold
/// and are close. Answers how many there are.
template <class Field>
int checkedParts(const Field& field, const FieldBounds& bounds, const Segment& segment, double column) {
  auto line = FieldLine<Field>::clip(field, bounds, segment);
  if (!line) return 0;
  line->refineAbove(column);
  Rng rng(kSeed);
  double reached = 0;
  int parts = 0;
  line->walk([&](double a, double b, const SuperVoxel& bound) {
    EXPECT_EQ(a, reached);
    EXPECT_LT(a, b);
    reached = b;
    ++parts;
    const bool isShortest = b - a <= 0x1p-36 * std::max(b, 1.0);
    const float rounding = 4.1e-7f * bounds.inForce().maximum(), upper = bound.upper - rounding;
    EXPECT_TRUE(isShortest || upper * (b - a) <= column || upper <= 2.001f * bound.lower)
        << bound.upper << ' ' << bound.lower << ' ' << b - a;
    const float room = isShortest ? 1e-9f : 0;
    for (int i = 0; i < 8; ++i) {
      const float density = line->density(a + (b - a) * rng.uniformDouble());
      EXPECT_LE(density, bound.upper + room) << a << ' ' << b;
      EXPECT_GE(density, bound.lower - rounding) << a << ' ' << b;
    }
    return parts < 100000;
  });
  EXPECT_EQ(reached, line->length());
  return parts;
}

TEST(CloserBounds, HoldAndAreFewUnderAnyExtinction) {
  Rng rng(kSeed);
  const ProceduralField noise = perlin();
  const FieldBounds noiseBounds = FieldBounds::proven(*noise.superVoxels());
  const GridField grid(test::randomGrid(9, 8, 7, GridBorder::Zero, 0.4f, kSeed), Transform());
  const FieldBounds gridBounds = FieldBounds::proven(grid.superVoxels());
  int fewest = 1 << 30, most = 0;
  for (int n = 0; n < 20; ++n) {
    const Segment segment = test::randomSegment(rng, 2);
    for (const double column : {1e-2, 1e-5, 1e-16, 5e-35}) {
      SCOPED_TRACE(testing::Message() << "segment " << n << ", column " << column);
      const int parts = checkedParts(noise, noiseBounds, segment, column);
      fewest = std::min(fewest, parts);
      most = std::max(most, parts);
      most = std::max(most, checkedParts(grid, gridBounds, segment, column));
    }
  }
  EXPECT_GT(most, 100) << "something was refined";
  EXPECT_LT(most, 20000);
}

TEST(CloserBounds, OfAShorterSegmentAreTheSameAsFarAsItGoes) {
  const ProceduralField field = perlin();
  const FieldBounds bounds = FieldBounds::proven(*field.superVoxels());
  const auto partsOf = [&](double tMax) {
    auto line = FieldLine<ProceduralField>::clip(field, bounds, {{-1, .4f, .3f}, {1, 0.1f, 0.2f}, 0, tMax});
    line->refineAbove(1e-7);
    std::vector<std::array<double, 3>> parts;
    line->walk([&](double, double b, const SuperVoxel& bound) {
      parts.push_back({b, double{bound.upper}, double{bound.lower}});
      return true;
    });
    return parts;
  };
  const auto whole = partsOf(10), part = partsOf(1.37);
  ASSERT_GT(part.size(), 20u);
  ASSERT_GT(whole.size(), part.size());
  for (std::size_t i = 0; i + 1 < part.size(); ++i) EXPECT_EQ(part[i], whole[i]) << i;
}

TEST(CloserBounds, ChangeNothingWhereNothingIsWanted) {
  const ProceduralField field = perlin();
  const FieldBounds bounds = FieldBounds::proven(*field.superVoxels());
  const Segment segment{{-1, .4f, .3f}, {1, 0, 0}, 0, 10};
  auto line = *FieldLine<ProceduralField>::clip(field, bounds, segment);
  std::vector<double> plain, refined;
  line.walk([&](double, double b, const SuperVoxel&) { return plain.push_back(b), true; });
  line.refineAbove(1e3);
  line.walk([&](double, double b, const SuperVoxel&) { return refined.push_back(b), true; });
  EXPECT_EQ(plain, refined);
}

}  // namespace
}  // namespace pbrtmedia
