// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_batch.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <stdexcept>

#include "base/rng.h"
#include "fields/constant_field.h"
#include "fields/field_line.h"
#include "fields/grid_field.h"
#include "support/grids.h"

namespace pbrtmedia {
namespace {

using test::randomGrid;
using test::randomSegment;
using Line = FieldLine<GridField>;

/// Returns to the best instruction set whatever a test does.
class GridBatch : public testing::Test {
 protected:
  void TearDown() override { useGridBatchTarget(""); }

  static GridField fieldOf(GridPrecision precision, GridLayout layout, GridBorder border = GridBorder::Zero) {
    auto params = randomGrid(23, 17, 9, border, .3f, 8);
    params.precision = precision;
    params.layout = layout;
    return GridField(params, Transform());
  }
};

struct Case {
  GridPrecision precision;
  GridLayout layout;
};
constexpr Case kCases[] = {{GridPrecision::Float, GridLayout::Linear},
                           {GridPrecision::Float, GridLayout::Bricked},
                           {GridPrecision::Half, GridLayout::Linear},
                           {GridPrecision::Half, GridLayout::Bricked}};

/// Compares a batch with its twin bit for bit, and the values around `out` with what they were.
void expectTwin(const Line& line, std::span<const double> s) {
  constexpr float kUntouched = -7;
  std::vector<float> out(s.size() + 2, kUntouched);
  line.densities(s, std::span(out).subspan(1, s.size()));
  EXPECT_EQ(out.front(), kUntouched);
  EXPECT_EQ(out.back(), kUntouched);
  for (std::size_t i = 0; i < s.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(out[i + 1]), std::bit_cast<std::uint32_t>(line.density(s[i])))
        << gridBatchTarget() << ", point " << i << " of " << s.size() << ", s = " << s[i];
  }
}

/// Whether the field's batch differs from its twin anywhere; for each instruction set and storage.
template <class Test>
void onEveryTargetAndStorage(Test&& test) {
  for (const std::string& target : gridBatchTargets()) {
    useGridBatchTarget(target);
    ASSERT_EQ(gridBatchTarget(), target);
    for (const Case& c : kCases) {
      SCOPED_TRACE(testing::Message() << target << ", precision " << static_cast<int>(c.precision)
                                      << ", layout " << static_cast<int>(c.layout));
      test(c);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST_F(GridBatch, EqualsItsTwinForEverySizeOfBatch) {
  onEveryTargetAndStorage([](const Case& c) {
    const GridField field = fieldOf(c.precision, c.layout);
    const FieldBounds bounds = FieldBounds::proven(field.superVoxels(1));
    Rng rng(1);
    for (std::size_t n = 0; n <= 67; ++n) {
      for (int ray = 0; ray < 20; ++ray) {
        const auto line = Line::clip(field, bounds, randomSegment(rng, 3 * rng.uniform()));
        if (!line) continue;
        std::vector<double> comb(n), any(n);
        const double u = rng.uniformDouble();
        for (std::size_t i = 0; i < n; ++i) {
          comb[i] = line->length() * (static_cast<double>(i) + u) / static_cast<double>(n);
          any[i] = line->length() * rng.uniformDouble();
        }
        expectTwin(*line, comb);
        expectTwin(*line, any);
      }
    }
  });
}

TEST_F(GridBatch, EqualsItsTwinAtTheEndsOfALineAndOnFacesAndEdges) {
  onEveryTargetAndStorage([](const Case& c) {
    const GridField field = fieldOf(c.precision, c.layout, GridBorder::Clamp);
    const FieldBounds bounds = FieldBounds::proven(field.superVoxels(2));
    Rng rng(2);
    for (int n = 0; n < 2000; ++n) {
      // Origins on faces, edges and corners of the box, on lattice planes, or anywhere.
      Segment s{{}, {}, 0, kInfinity};
      const int counts[3] = {23, 17, 9};
      for (std::size_t a = 0; a < 3; ++a) {
        const float u = rng.uniform(), count = static_cast<float>(counts[a]);
        s.o[a] =
            u < .4f ? static_cast<float>(rng.uniformInt(2))
            : u < .7f
                ? (static_cast<float>(rng.uniformInt(static_cast<std::uint32_t>(counts[a]))) + .5f) / count
                : rng.uniform();
        s.d[a] = rng.uniform() < .4f ? 0.0f : 2 * rng.uniform() - 1;
      }
      if (rng.uniform() < .5f) {  // along an axis
        const std::size_t axis = rng.uniformInt(3);
        s.d = {};
        s.d[axis] = rng.uniform() < .5f ? 1.0f : -1.0f;
      }
      if (rng.uniform() < .3f) s.o = s.o - 2.0f * s.d;
      const auto line = Line::clip(field, bounds, s);
      if (!line) continue;
      const double l = line->length();
      const double points[] = {0, l, std::nextafter(l, 0.0), l / 2, 0x1p-1074, l * 0x1p-53, l * (1 - 0x1p-53),
                               0, l};
      expectTwin(*line, points);
    }
  });
}

TEST_F(GridBatch, EqualsItsTwinOnGridsThinnerThanACell) {
  onEveryTargetAndStorage([](const Case& c) {
    for (const Vec3<int> n : {Vec3<int>(1, 1, 1), Vec3<int>(64, 1, 1), Vec3<int>(1, 2, 33)}) {
      auto params = randomGrid(n.x, n.y, n.z, GridBorder::Clamp, 0, 4);
      params.precision = c.precision;
      params.layout = c.layout;
      const GridField field(params, Transform());
      const FieldBounds bounds = FieldBounds::proven(field.superVoxels(2));
      Rng rng(5);
      for (int ray = 0; ray < 200; ++ray) {
        const auto line = Line::clip(field, bounds, randomSegment(rng, 2));
        if (!line) continue;
        std::vector<double> s(19);
        for (double& x : s) x = line->length() * rng.uniformDouble();
        s[3] = 0;
        s[7] = line->length();
        expectTwin(*line, s);
      }
    }
  });
}

TEST_F(GridBatch, RunsOnTheScalarTwinAndNamesItsTargets) {
  const auto targets = gridBatchTargets();
  ASSERT_FALSE(targets.empty());
  EXPECT_EQ(gridBatchTarget(), targets.front());
  EXPECT_THROW(useGridBatchTarget("abacus"), std::invalid_argument);
  EXPECT_EQ(gridBatchTarget(), targets.front());
}

TEST(FieldLineBatch, OfAConstantFieldIsItsDensity) {
  const ConstantField field({.5f}, Transform());
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels());
  const auto line = FieldLine<ConstantField>::clip(field, bounds, {{-1, .5f, .5f}, {1, 0, 0}, 0, kInfinity});
  ASSERT_TRUE(line);
  const double s[] = {0, .25, .5, .75, 1};
  float out[] = {9, 9, 9, 9, 9, 9};
  line->densities(s, std::span(out).first(5));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(out[i], .5f);
  EXPECT_EQ(out[5], 9.0f);
}

}  // namespace
}  // namespace pbrtmedia
