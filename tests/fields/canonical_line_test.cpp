// SPDX-License-Identifier: BSD-2-Clause
#include "fields/canonical_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pbrtmedia {
namespace {

class EveryLine : public ::testing::TestWithParam<std::string_view> {
 protected:
  CanonicalFunction f_ = findCanonicalFunction(GetParam()).value();
};

TEST_P(EveryLine, BoundsHoldMeansAreExactAndIntervalsJoin) {
  for (const unsigned superVoxels : {1u, 2u, 7u, 64u}) {
    const CanonicalLine line(f_, {.length = 3, .scale = 0.7, .lower = 1, .superVoxels = superVoxels});
    double end = 0, integral = 0;
    for (const CanonicalLine::Interval& i : line.intervals()) {
      EXPECT_EQ(i.sEnter, end);
      end = i.sExit;
      integral += (i.sExit - i.sEnter) * i.bound.mean;
      for (int j = 0; j <= 1000; ++j) {
        const double density = line.density(i.sEnter + (i.sExit - i.sEnter) * j / 1000);
        EXPECT_LE(density, i.bound.upper);
        EXPECT_GE(density, i.bound.lower);
      }
    }
    EXPECT_EQ(line.intervals().size(), superVoxels);
    EXPECT_EQ(end, 3);
    EXPECT_NEAR(integral / line.integral(), 1, 1e-13);
    EXPECT_GE(line.upperIntegral(), line.integral() * (1 - 1e-13));
    double lower = 0;
    for (const CanonicalLine::Interval& i : line.intervals()) lower += (i.sExit - i.sEnter) * i.bound.lower;
    EXPECT_LE(lower, line.integral() * (1 + 1e-13));
  }
}

TEST_P(EveryLine, PiecesOfPolynomialsIntegrateExactly) {
  const CanonicalLine line(f_, {.length = 2});
  if (!line.isPiecewiseCubic()) return;
  double sum = 0, end = 0;
  line.walkPieces([&](double a, double b) {
    EXPECT_EQ(a, end);
    end = b;
    sum += (b - a) * line.density((a + b) / 2);  // exact: degree <= 1
    return true;
  });
  EXPECT_EQ(end, line.length());
  EXPECT_NEAR(sum / line.integral(), 1, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(CanonicalLine, EveryLine, ::testing::ValuesIn(canonicalFunctionNames()),
                         [](const auto& tested) {
                           std::string name(tested.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(CanonicalLine, ControlAndLowerScaleTheBounds) {
  const CanonicalFunction f = findCanonicalFunction("composite-sine").value();
  const CanonicalLine line(f, {.scale = 2, .control = 0.6, .lower = 0.5});
  EXPECT_NEAR(line.intervals()[0].bound.upper, 0.6 * 2 * 1.6463, 2e-4);
  EXPECT_NEAR(line.intervals()[0].bound.lower, 0.5 * 2 * 0.4403, 2e-4);
  const CanonicalLine plain(f, {.hasMeans = false});
  EXPECT_EQ(plain.intervals()[0].bound.lower, 0);
  EXPECT_FALSE(plain.intervals()[0].bound.hasMean());
}

TEST(CanonicalLine, LowerBoundsMayBeDensitiesThatFunctionsGoBelow) {
  const CanonicalFunction f = findCanonicalFunction("linear-up").value();
  const CanonicalLine line(f, {.scale = 3, .superVoxels = 4, .lowerDensity = 2});
  EXPECT_EQ(line.intervals()[3].bound.lower, 2);
  EXPECT_NEAR(line.intervals()[0].bound.lower, 1.5, 1e-9) << "no higher than the upper one";
  EXPECT_FALSE(line.hasProvenBounds());
  const CanonicalFunction step = findCanonicalFunction("step").value();
  EXPECT_TRUE(CanonicalLine(step, {.lowerDensity = 0.2}).hasProvenBounds());
  EXPECT_FALSE(CanonicalLine(step, {.lowerDensity = 0.21}).hasProvenBounds());
}

TEST(CanonicalLine, IsCutAtItsEnd) {
  const CanonicalFunction f = findCanonicalFunction("step").value();
  const CanonicalLine whole(f, {.length = 4, .superVoxels = 4});
  const CanonicalLine line(f, {.length = 4, .superVoxels = 4, .end = 2.5});
  EXPECT_EQ(line.length(), 2.5);
  ASSERT_EQ(line.intervals().size(), 3u);
  EXPECT_EQ(line.intervals()[2].sExit, 2.5);
  EXPECT_EQ(line.intervals()[2].bound.upper, whole.intervals()[2].bound.upper);
  EXPECT_NEAR(line.integral(), 2.4 * 0.2 + 0.1 * 2.2, 1e-12);
  EXPECT_NEAR(line.intervals()[2].bound.mean * 0.5, 0.4 * 0.2 + 0.1 * 2.2, 1e-12);
  EXPECT_EQ(line.density(1.9), whole.density(1.9));
  double end = 0;
  line.walkPieces([&](double, double b) {
    end = b;
    return true;
  });
  EXPECT_EQ(end, 2.5);
  const CanonicalLine beyond(f, {.length = 4, .end = 9});
  EXPECT_EQ(beyond.length(), 4);
  EXPECT_EQ(beyond.integral(), whole.integral());
}

TEST_P(EveryLine, IsTheSameInStretches) {
  const CanonicalLine line(f_, {.length = 3, .offset = .5, .scale = .7, .lower = 1, .superVoxels = 7});
  double integral = 0;
  for (const double a : {0., .3, 1.1, 2.9}) {
    const double b = a == 0 ? .3 : a == .3 ? 1.1 : a == 1.1 ? 2.9 : 3;
    const CanonicalLine part = line.stretch(a, b);
    EXPECT_EQ(part.length(), b - a);
    EXPECT_EQ(part.hasProvenBounds(), line.hasProvenBounds());
    integral += part.integral();
    double end = 0;
    part.walk([&](double sEnter, double sExit, const DensityBounds<double>& bound) {
      EXPECT_EQ(sEnter, end);
      end = sExit;
      const double middle = (sEnter + sExit) / 2;
      EXPECT_EQ(part.density(middle), line.density(a + middle));
      EXPECT_EQ(bound.upper, line.intervals()[line.intervalAt(a + middle)].bound.upper);
      return true;
    });
    EXPECT_EQ(end, part.length());
    if (part.isPiecewiseCubic()) {
      double sum = 0;
      part.walkPieces([&](double sEnter, double sExit) {
        sum += (sExit - sEnter) * part.density((sEnter + sExit) / 2);
        return true;
      });
      EXPECT_NEAR(sum, part.integral(), 1e-12 * line.integral());
    }
    const CanonicalLine inner = part.stretch((b - a) / 4, b - a);
    EXPECT_NEAR(inner.density(0), line.density(a + (b - a) / 4), 1e-9);
  }
  EXPECT_NEAR(integral / line.integral(), 1, 1e-12);
}

TEST(CanonicalLine, TakesOtherUpperBoundsAndClampsToThem) {
  const CanonicalFunction f = findCanonicalFunction("step").value();
  CanonicalLine line(f, {.lower = 1, .superVoxels = 2});
  EXPECT_EQ(line.intervalAt(0), 0u);
  EXPECT_EQ(line.intervalAt(0.5), 1u);
  EXPECT_EQ(line.intervalAt(1), 1u);
  const double uppers[] = {0.1, 1};
  line.setUppers(uppers, false);
  EXPECT_FALSE(line.hasProvenBounds());
  EXPECT_EQ(line.upperIntegral(), 0.55);
  EXPECT_EQ(line.intervals()[0].bound.lower, 0.1);
  EXPECT_EQ(line.density(0.8), 2.2);
  line.setUppers(uppers, true);
  EXPECT_EQ(line.density(0.2), 0.1);
  EXPECT_EQ(line.density(0.8), 1);
  EXPECT_NEAR(line.integral(), 1, 1e-12) << "of the density that is";
}

TEST(CanonicalLine, AnyLengthCarriesTheSameShape) {
  const CanonicalFunction f = findCanonicalFunction("cosine").value();
  for (const double length : {1e-30, 0.5, 1e30}) {
    const CanonicalLine line(f, {.length = length, .superVoxels = 5});
    EXPECT_DOUBLE_EQ(line.density(0.25 * length), f(0.25));
    EXPECT_DOUBLE_EQ(line.integral(), f.integral() * length);
    EXPECT_EQ(line.intervals().back().sExit, length);
  }
  const CanonicalLine none(f, {.length = 0});
  EXPECT_TRUE(none.intervals().empty());
  EXPECT_EQ(none.integral(), 0);
}

TEST(CanonicalLine, AnOffsetCostsDigitsOnly) {
  const CanonicalFunction f = findCanonicalFunction("cosine").value();
  const CanonicalLine line(f, {.offset = 1e6});
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(line.density(i / 100.0), f(i / 100.0), 20 * 1e-10);
}

TEST(CanonicalLine, KnowsWhetherItsBoundsAreTrue) {
  const CanonicalFunction f = findCanonicalFunction("cosine").value();
  const auto isProven = [&](const CanonicalLine::Setup& setup) {
    return CanonicalLine(f, setup).hasProvenBounds();
  };
  EXPECT_TRUE(isProven({}));
  EXPECT_TRUE(isProven({.control = 3, .lower = 1, .superVoxels = 8, .leastUpper = 7}));
  EXPECT_FALSE(isProven({.control = 0.99}));
  EXPECT_FALSE(isProven({.lower = 1.01}));
  EXPECT_FALSE(isProven({.superVoxels = 8, .blind = 3}));
  EXPECT_TRUE(isProven({.superVoxels = 8, .blind = 8})) << "there is no such interval";
}

TEST(CanonicalLine, BoundsHoldAtAnyOffset) {
  const CanonicalFunction f = findCanonicalFunction("piecewise-random").value();
  const CanonicalLine line(f, {.offset = 12345.678, .lower = 1, .superVoxels = 96});
  for (const CanonicalLine::Interval& i : line.intervals()) {
    for (const double s : {i.sEnter, std::nextafter(i.sEnter, 2.0), std::nextafter(i.sExit, 0.0)}) {
      EXPECT_LE(line.density(s), i.bound.upper) << s;
      EXPECT_GE(line.density(s), i.bound.lower) << s;
    }
  }
}

TEST(CanonicalLine, RecordsItsLookUps) {
  const CanonicalFunction f = findCanonicalFunction("cosine").value();
  CanonicalLine line(f, {});
  std::vector<double> points;
  line.record(&points);
  line.density(0.25);
  line.density(0.5);
  line.record(nullptr);
  line.density(0.75);
  EXPECT_EQ(points, (std::vector{0.25, 0.5}));
}

}  // namespace
}  // namespace pbrtmedia
