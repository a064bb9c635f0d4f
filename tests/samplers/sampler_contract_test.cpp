// SPDX-License-Identifier: BSD-2-Clause
// What every sampler must do.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "base/diagnostics.h"
#include "samplers/all_samplers.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

class AnySampler : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(, AnySampler, testing::ValuesIn(kSamplerNames), [](const auto& test) {
  return test.param == "02sequence" ? "zero_two" : test.param;
});

/// Film, time, lens and 11 more numbers, as a path would ask for them: 16 dimensions.
constexpr std::size_t kDimensions = 16;
using Numbers = std::array<float, kDimensions>;

Numbers numbersOf(Sampler& s, Point2i pixel, std::int64_t index) {
  s.start(pixel, index);
  Numbers n{};
  std::size_t d = 0;
  const auto one = [&] { n[d++] = s.get1D(); };
  const auto two = [&] {
    const Point2f p = s.get2D();
    n[d++] = p.x;
    n[d++] = p.y;
  };
  two(), one(), two(), one(), two(), two(), one(), one(), two(), one(), one();
  return n;
}

TEST_P(AnySampler, KeepsItsNameSeedAndCountInClones) {
  const auto s = makeSampler(GetParam(), 4, 99), c = s->clone();
  EXPECT_EQ(s->typeName(), GetParam());
  EXPECT_EQ(c->typeName(), GetParam());
  EXPECT_EQ(s->samplesPerPixel(), 16);
  EXPECT_EQ(c->samplesPerPixel(), 16);
  EXPECT_EQ(c->seed(), 99u);
}

TEST_P(AnySampler, StaysInTheUnitIntervalForAnyPixelIndexAndSeed) {
  constexpr int kFar = std::numeric_limits<int>::max();
  for (const std::uint64_t seed :
       {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}, std::uint64_t{1} << 63}) {
    const auto s = makeSampler(GetParam(), 4, seed);
    for (const Point2i pixel :
         {Point2i{0, 0}, {-5, -7}, {kFar, kFar}, {std::numeric_limits<int>::min(), 3}}) {
      for (const std::int64_t first :
           {std::int64_t{0}, std::int64_t{1000}, (std::int64_t{1} << 32) - 8, (std::int64_t{1} << 40),
            std::numeric_limits<std::int64_t>::max() - 40}) {
        for (std::int64_t i = first; i < first + 32; ++i) {
          for (const float x : numbersOf(*s, pixel, i)) {
            ASSERT_GE(x, 0.0f);
            ASSERT_LT(x, 1.0f);
          }
        }
      }
    }
  }
}

TEST_P(AnySampler, IsAPureFunctionOfPixelAndIndex) {
  const auto s = makeSampler(GetParam(), 4, 5), other = s->clone();
  std::vector<Numbers> forwards;
  for (int p = 0; p < 20; ++p) {
    for (int i = 0; i < 40; ++i) forwards.push_back(numbersOf(*s, {p, 3 * p}, i));
  }
  for (int p = 19; p >= 0; --p) {  // the other way round, with detours
    for (int i = 39; i >= 0; --i) {
      numbersOf(*other, {i, p}, 7);
      ASSERT_EQ(numbersOf(*other, {p, 3 * p}, i), forwards[static_cast<std::size_t>(p * 40 + i)]);
    }
  }
}

TEST_P(AnySampler, DependsOnSeedPixelAndIndex) {
  const auto a = makeSampler(GetParam(), 4, 1), b = makeSampler(GetParam(), 4, 2);
  const Numbers n = numbersOf(*a, {3, 4}, 5);
  for (const Numbers& m : {numbersOf(*b, {3, 4}, 5), numbersOf(*a, {4, 3}, 5), numbersOf(*a, {3, 5}, 5),
                           numbersOf(*a, {3, 4}, 6), numbersOf(*a, {3, 4}, 5 + 16),
                           numbersOf(*a, {3, 4}, 5 + (std::int64_t{1} << 32))}) {
    for (std::size_t d = 0; d < kDimensions; ++d) EXPECT_NE(n[d], m[d]) << d;
  }
}

TEST_P(AnySampler, FillsEveryPairOfDimensionsUniformlyOverPixels) {
  constexpr int kCells = 8, kPixels = 12000;
  const auto s = makeSampler(GetParam());
  std::vector<Numbers> all;
  for (int p = 0; p < kPixels; ++p) all.push_back(numbersOf(*s, {p % 120, p / 120}, p % 7));
  for (std::size_t a = 0; a < kDimensions; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      std::vector<double> counts(kCells * kCells);
      for (const Numbers& n : all)
        ++counts[static_cast<std::size_t>(n[a] * kCells) * kCells + static_cast<std::size_t>(n[b] * kCells)];
      const ChiSquareTest test = chiSquareUniform(counts);
      EXPECT_GT(test.pValue(), sidak(kMinPValue, 120)) << a << ' ' << b << ": " << test;
    }
  }
}

// Inside one pixel the samples of two dimensions must not follow each other: over many pixels the mean
// product of deviations is 0. Padding by equal shuffles, or bad projections of one sequence, would show here.
TEST_P(AnySampler, HasNoCorrelationBetweenDimensionsWithinPixels) {
  const auto s = makeSampler(GetParam());
  std::array<std::array<RunningStats, kDimensions>, kDimensions> products;
  for (int p = 0; p < 6000; ++p) {
    std::array<std::array<double, kDimensions>, kDimensions> sums{};
    for (int i = 0; i < 16; ++i) {
      const Numbers n = numbersOf(*s, {p, 17}, i);
      for (std::size_t a = 0; a < kDimensions; ++a) {
        for (std::size_t b = 0; b < a; ++b) sums[a][b] += (n[a] - 0.5) * (n[b] - 0.5) / 16;
      }
    }
    for (std::size_t a = 0; a < kDimensions; ++a) {
      for (std::size_t b = 0; b < a; ++b) products[a][b].add(sums[a][b]);
    }
  }
  const double expectedOfRandom = 1.0 / 12 / 12 / 16;  // variance of the mean of 16 products
  for (std::size_t a = 0; a < kDimensions; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const ZTest test = zTest(products[a][b], 0);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << a << ' ' << b << ": " << test;
      // Shuffling in blocks of 1, 1, 2, 4 and 8 samples gives the product of the first binary digits, the
      // worst part, (4 + sum of m^2 / (m - 1)) / 16 = 1.40 times the variance of random numbers. 9 % are five
      // standard errors of the variance of 6000 normal values.
      EXPECT_LT(products[a][b].variance(), 1.40 * 1.09 * expectedOfRandom) << a << ' ' << b;
    }
  }
}

TEST_P(AnySampler, IntegratesAProductOverAllDimensionsWithoutBias) {
  const auto s = makeSampler(GetParam());
  RunningStats pixels;
  for (int p = 0; p < 4000; ++p) {
    double sum = 0;
    for (int i = 0; i < 16; ++i) {
      double f = 1;
      for (const float x : numbersOf(*s, {p % 64, p / 64}, i)) f *= 1 + (x - 0.5);
      sum += f / 16;
    }
    pixels.add(sum);
  }
  const ZTest test = zTest(pixels, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST_P(AnySampler, NeighbouringPixelsAreIndependent) {
  const auto s = makeSampler(GetParam());
  for (const Point2i step : {Point2i{1, 0}, {0, 1}, {1, 1}, {64, 0}}) {
    for (const std::size_t d : {0u, 1u, 2u, 7u}) {
      std::vector<double> counts(64);
      for (int p = 0; p < 6000; ++p) {
        const Point2i pixel{2 * step.x * (p % 80) + 3 * (p % 80), 5 * (p / 80)};
        const float a = numbersOf(*s, pixel, 3)[d], b = numbersOf(*s, pixel + step, 3)[d];
        ++counts[static_cast<std::size_t>(a * 8) * 8 + static_cast<std::size_t>(b * 8)];
      }
      const ChiSquareTest test = chiSquareUniform(counts);
      EXPECT_GT(test.pValue(), sidak(kMinPValue, 16)) << step << ' ' << d << ": " << test;
    }
  }
}

TEST_P(AnySampler, ArraysTakeOneSlotWhateverTheirLength) {
  const auto s = makeSampler(GetParam());
  std::vector<float> after;
  for (const std::size_t n : {0u, 1u, 2u, 5u, 64u}) {
    std::vector<Point2f> points(n, {-1, -1});
    s->start({8, 9}, 3);
    s->get2D();
    s->get2DArray(points);
    for (const Point2f p : points) {
      EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << p;
    }
    after.push_back(s->get1D());
    EXPECT_EQ(after.back(), after.front()) << n;
  }
}

TEST_P(AnySampler, ArraysAreUniformAndUnbiased) {
  const auto s = makeSampler(GetParam());
  std::vector<double> counts(64);
  RunningStats means;
  for (int p = 0; p < 3000; ++p) {
    std::array<Point2f, 5> points;
    s->start({p, 1}, p % 16);
    s->get2DArray(points);
    const Point2f one = points[static_cast<std::size_t>(p % 5)];
    ++counts[static_cast<std::size_t>(one.x * 8) * 8 + static_cast<std::size_t>(one.y * 8)];
    double sum = 0;
    for (const Point2f q : points) sum += q.x * q.y / 5;
    means.add(sum);
  }
  EXPECT_GT(chiSquareUniform(counts).pValue(), kMinPValue) << chiSquareUniform(counts);
  EXPECT_LT(std::abs(zTest(means, 0.25).z()), kMaxAbsZ) << zTest(means, 0.25);
}

double smooth(Point2f p) { return p.x * p.y + 0.5 * p.x + double{p.y} * p.y; }
constexpr double kSmoothMean = 0.25 + 0.25 + 1.0 / 3;
// Variance: E[f^2] - mean^2, with E[x^2 y^2] = 1/9, E[x^2]/4 = 1/12, E[y^4] = 1/5, E[x^2 y] = 1/6,
// 2 E[x y^3] = 1/4, E[x y^2] = 1/6.
constexpr double kSmoothVariance =
    1.0 / 9 + 1.0 / 12 + 1.0 / 5 + 1.0 / 6 + 1.0 / 4 + 1.0 / 6 - kSmoothMean * kSmoothMean;

/// Means over samples [first, first + count) of many pixels, in 2D slot `slot`.
RunningStats pixelMeans(Sampler& s, int slot, std::int64_t first, int count) {
  RunningStats means;
  for (int p = 0; p < 1200; ++p) {
    double sum = 0;
    for (const Point2f q : slotPoints(s, {p, 5}, slot, first, count)) sum += smooth(q);
    means.add(sum / count);
  }
  return means;
}

TEST_P(AnySampler, IntegratesASmoothFunctionBetterThanRandomInEverySlot) {
  const auto s = makeSampler(GetParam());
  for (const int slot : {0, 1, 2, 9}) {
    const RunningStats means = pixelMeans(*s, slot, 0, 16);
    EXPECT_LT(std::abs(zTest(means, kSmoothMean).z()), kMaxAbsZ) << slot << ": " << zTest(means, kSmoothMean);
    const double ratio = means.variance() * 16 / kSmoothVariance;
    if (GetParam() == "random") {
      EXPECT_NEAR(ratio, 1, kMaxAbsZ * std::sqrt(2.0 / 1200)) << slot;
    } else {
      EXPECT_LT(ratio, 0.15) << slot;
    }
  }
}

TEST_P(AnySampler, GoesOnBeyondItsCountAsWell) {
  const auto s = makeSampler(GetParam());
  for (const std::int64_t first : {std::int64_t{0}, std::int64_t{16}, std::int64_t{1} << 34}) {
    const RunningStats means = pixelMeans(*s, 2, first, 32);
    EXPECT_LT(std::abs(zTest(means, kSmoothMean).z()), kMaxAbsZ)
        << first << ": " << zTest(means, kSmoothMean);
    if (GetParam() != "random") {
      EXPECT_LT(means.variance() * 32 / kSmoothVariance, 0.1) << first;
    }
  }
}

TEST_P(AnySampler, ArrayPointsOfAllSamplesAreWellDistributedTogether) {
  const auto s = makeSampler(GetParam());
  RunningStats means;
  for (int p = 0; p < 1200; ++p) {
    double sum = 0;
    for (int i = 0; i < 16; ++i) {
      std::array<Point2f, 4> points;
      s->start({p, 6}, i);
      s->get2DArray(points);
      for (const Point2f q : points) sum += smooth(q);
    }
    means.add(sum / 64);
  }
  EXPECT_LT(std::abs(zTest(means, kSmoothMean).z()), kMaxAbsZ) << zTest(means, kSmoothMean);
  if (GetParam() != "random") {
    EXPECT_LT(means.variance() * 64 / kSmoothVariance, 0.05);
  }
}

TEST_P(AnySampler, CameraSamplesTakeFilmThenTimeThenLens) {
  const auto s = makeSampler(GetParam());
  s->start({10, -3}, 2);
  const Point2f film = s->get2D();
  const float time = s->get1D();
  const Point2f lens = s->get2D();
  s->start({10, -3}, 2);
  const CameraSample c = s->cameraSample({10, -3});
  EXPECT_EQ(c.film, (Point2f{10 + film.x, -3 + film.y}));
  EXPECT_EQ(c.time, time);
  EXPECT_EQ(c.lens, lens);
}

TEST_P(AnySampler, CameraSamplesNeverRoundIntoTheNextPixel) {
  const auto s = makeSampler(GetParam());
  for (const int x : {0, 1000, 1 << 20, -1000}) {
    for (int i = 0; i < 4000; ++i) {
      s->start({x, i}, 0);
      const CameraSample c = s->cameraSample({x, i});
      ASSERT_GE(c.film.x, static_cast<float>(x));
      ASSERT_LT(c.film.x, static_cast<float>(x + 1));
    }
  }
}

TEST(SamplerCounts, RoundUpOnlyWherePbrtDoes) {
  EXPECT_EQ(RandomSampler({.pixelSamples = 10}).samplesPerPixel(), 10);
  EXPECT_EQ(HaltonSampler({.pixelSamples = 10}).samplesPerPixel(), 10);
  EXPECT_EQ(SobolSampler({.pixelSamples = 10}).samplesPerPixel(), 16);
  EXPECT_EQ(ZeroTwoSampler({.pixelSamples = 10}).samplesPerPixel(), 16);
  EXPECT_EQ(MaxMinDistSampler({.pixelSamples = 17}).samplesPerPixel(), 32);
  EXPECT_EQ(SobolSampler({.pixelSamples = 16}).samplesPerPixel(), 16);
  EXPECT_EQ(SobolSampler({.pixelSamples = 1}).samplesPerPixel(), 1);
  EXPECT_EQ(StratifiedSampler({.xSamples = 3, .ySamples = 5}).samplesPerPixel(), 15);
}

TEST(SamplerCounts, DefaultsAreThoseOfPbrt) {
  EXPECT_EQ(RandomSampler({}).samplesPerPixel(), 4);
  for (const std::int64_t n : {HaltonSampler({}).samplesPerPixel(), SobolSampler({}).samplesPerPixel(),
                               ZeroTwoSampler({}).samplesPerPixel(), MaxMinDistSampler({}).samplesPerPixel(),
                               StratifiedSampler({}).samplesPerPixel()})
    EXPECT_EQ(n, 16);
}

TEST(SamplerCounts, OutOfRangeAreErrorsThatNameThem) {
  EXPECT_THROW(RandomSampler({.pixelSamples = 0}), SceneError);
  EXPECT_THROW(HaltonSampler({.pixelSamples = -1}), SceneError);
  EXPECT_THROW(SobolSampler({.pixelSamples = (std::int64_t{1} << 31) + 1}), SceneError);
  EXPECT_THROW(ZeroTwoSampler({.dimensions = -1}), SceneError);
  EXPECT_THROW(MaxMinDistSampler({.pixelSamples = 0}), SceneError);
  EXPECT_THROW(StratifiedSampler({.ySamples = 0}), SceneError);
  try {
    StratifiedSampler({.xSamples = -2});
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_STREQ(e.what(), "sampler \"stratified\": xsamples is -2; expected 1 to 32768");
  }
}

}  // namespace
}  // namespace pbrtmedia
