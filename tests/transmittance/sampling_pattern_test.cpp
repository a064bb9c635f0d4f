// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/sampling_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "support/statistics.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {
namespace {

constexpr PatternKind kKinds[] = {PatternKind::Independent, PatternKind::LatinHypercube,
                                  PatternKind::Hammersley, PatternKind::Halton, PatternKind::ScrambledHalton};
constexpr std::uint64_t kKey = 0x5eed;

std::string_view nameOf(PatternKind kind) { return kPatternNames[static_cast<std::size_t>(kind)]; }

TEST(SamplingPattern, IsAPureFunctionWithValuesBelowOne) {
  for (const PatternKind kind : kKinds) {
    for (const std::uint32_t count : {1u, 2u, 17u, 4096u}) {
      const SamplingPattern a(kind, count, kKey), b(kind, count, kKey), other(kind, count, kKey + 1);
      EXPECT_EQ(a.count(), count);
      int differences = 0;
      for (std::uint32_t d = 0; d < 700; ++d) {
        const double value = a.value(count - 1, d);
        ASSERT_GE(value, 0.0);
        ASSERT_LT(value, 1.0);
        ASSERT_EQ(value, b.value(count - 1, d));
        differences += value != other.value(count - 1, d) ? 1 : 0;
      }
      EXPECT_GT(differences, 690) << nameOf(kind);
    }
  }
}

TEST(SamplingPattern, IsUniformInEachDimensionOverTheKeys) {
  const std::uint32_t dimensions[] = {
      0, 1, 2, 7, 100, SamplingPattern::kDimensions - 1, SamplingPattern::kDimensions, 5000};
  for (const PatternKind kind : kKinds) {
    for (const std::uint32_t dimension : dimensions) {
      std::vector<double> values;
      std::vector<double> counts(20, 0);
      for (std::uint64_t key = 0; key < 4000; ++key) {
        const double value = SamplingPattern(kind, 12, key).value(5, dimension);
        values.push_back(value);
        ++counts[static_cast<std::size_t>(value * 20)];
      }
      const auto ks = test::ksTestUniform(values);
      EXPECT_GT(ks.pValue(), test::kMinPValue) << nameOf(kind) << ", dimension " << dimension << ": " << ks;
      const auto chi = test::chiSquareUniform(counts);
      EXPECT_GT(chi.pValue(), test::kMinPValue) << nameOf(kind) << ", dimension " << dimension << ": " << chi;
    }
  }
}

TEST(SamplingPattern, HasIndependentDimensionsAtEachPointOverTheKeys) {
  // What keeps a product over dimensions unbiased: pairs fill the square, whatever the pattern.
  const std::uint32_t pairs[][2] = {{0, 1}, {1, 2}, {3, 9}, {510, 511}, {511, 512}, {512, 513}};
  for (const PatternKind kind : kKinds) {
    for (const auto& pair : pairs) {
      std::vector<double> counts(64, 0);
      for (std::uint64_t key = 0; key < 6000; ++key) {
        const SamplingPattern pattern(kind, 16, key);
        const auto cell = [&](std::uint32_t d) { return static_cast<std::size_t>(pattern.value(9, d) * 8); };
        ++counts[cell(pair[0]) * 8 + cell(pair[1])];
      }
      const auto chi = test::chiSquareUniform(counts);
      EXPECT_GT(chi.pValue(), test::kMinPValue)
          << nameOf(kind) << ", " << pair[0] << " and " << pair[1] << ": " << chi;
    }
  }
}

TEST(SamplingPattern, NeverRepeatsADimension) {
  for (const PatternKind kind : kKinds) {
    const SamplingPattern pattern(kind, 64, kKey);
    std::set<double> seen;
    std::size_t values = 0;
    for (const std::uint32_t index : {3u, 40u}) {
      for (std::uint32_t d = 0; d < 4 * SamplingPattern::kDimensions; ++d, ++values) {
        seen.insert(pattern.value(index, d));
      }
    }
    EXPECT_EQ(seen.size(), values) << nameOf(kind);
  }
}

TEST(SamplingPattern, IsHashedAndIndependentBeyondItsTable) {
  // Neighbours in index and in dimension do not know each other there.
  for (const PatternKind kind : kKinds) {
    const SamplingPattern pattern(kind, 64, kKey);
    std::vector<double> byIndex(64, 0), byDimension(64, 0);
    for (std::uint32_t d = SamplingPattern::kDimensions; d < SamplingPattern::kDimensions + 200; ++d) {
      for (std::uint32_t i = 0; i + 1 < 64; ++i) {
        const auto cell = [](double v) { return static_cast<std::size_t>(v * 8); };
        const std::size_t here = cell(pattern.value(i, d));
        ++byIndex[here * 8 + cell(pattern.value(i + 1, d))];
        ++byDimension[here * 8 + cell(pattern.value(i, d + 1))];
      }
    }
    EXPECT_GT(test::chiSquareUniform(byIndex).pValue(), test::kMinPValue) << nameOf(kind);
    EXPECT_GT(test::chiSquareUniform(byDimension).pValue(), test::kMinPValue) << nameOf(kind);
  }
}

TEST(SamplingPattern, LatinHypercubeHasOnePointInEachStratumOfEachDimension) {
  for (const std::uint32_t count : {1u, 2u, 7u, 16u, 17u, 64u, 1000u}) {
    const SamplingPattern pattern(PatternKind::LatinHypercube, count, kKey);
    for (const std::uint32_t d : {0u, 1u, 50u, 511u}) {
      std::vector<int> hits(count, 0);
      for (std::uint32_t i = 0; i < count; ++i) ++hits[static_cast<std::size_t>(pattern.value(i, d) * count)];
      for (const int h : hits) ASSERT_EQ(h, 1) << count << " points, dimension " << d;
    }
  }
}

TEST(SamplingPattern, LatinHypercubeJittersWithinItsStrataAndPermutesThem) {
  std::vector<double> jitter, counts(36, 0);
  for (std::uint64_t key = 0; key < 6000; ++key) {
    const SamplingPattern pattern(PatternKind::LatinHypercube, 6, key);
    const double a = pattern.value(2, 4) * 6, b = pattern.value(5, 4) * 6;
    jitter.push_back(a - std::floor(a));
    ++counts[static_cast<std::size_t>(a) * 6 + static_cast<std::size_t>(b)];
  }
  EXPECT_GT(test::ksTestUniform(jitter).pValue(), test::kMinPValue);
  // Two points share no stratum and meet all 30 pairs of strata equally often.
  std::vector<double> expected(36, 200);
  for (std::size_t i = 0; i < 6; ++i) expected[7 * i] = 0;
  const auto chi = test::chiSquareTest(counts, expected);
  EXPECT_GT(chi.pValue(), test::kMinPValue) << chi;
}

/// Coordinate without the random shift of its dimension, that of point 0; what rounding carries below a
/// multiple of 1/2^20 is carried back.
double unshifted(const SamplingPattern& pattern, std::uint32_t index, std::uint32_t dimension) {
  const double difference = pattern.value(index, dimension) - pattern.value(0, dimension) + 1e-12;
  return difference < 0 ? difference + 1 : difference;
}

/// Points in every box of the columns x rows grid.
template <class Coordinate>
std::vector<int> boxCounts(std::uint32_t points, std::uint32_t columns, std::uint32_t rows,
                           Coordinate&& coordinate) {
  std::vector<int> counts(std::size_t{columns} * rows, 0);
  for (std::uint32_t i = 0; i < points; ++i) {
    const auto x = static_cast<std::uint32_t>(coordinate(i, 0) * columns),
               y = static_cast<std::uint32_t>(coordinate(i, 1) * rows);
    ++counts.at(std::size_t{y} * columns + x);
  }
  return counts;
}

TEST(SamplingPattern, HammersleyIsANetInItsFirstTwoDimensions) {
  const SamplingPattern pattern(PatternKind::Hammersley, 256, kKey);
  for (std::uint32_t columns = 1, rows = 256; columns <= 256; columns *= 2, rows /= 2) {
    const auto counts = boxCounts(256, columns, rows,
                                  [&](std::uint32_t i, std::uint32_t d) { return unshifted(pattern, i, d); });
    for (const int c : counts) ASSERT_EQ(c, 1) << columns << " x " << rows;
  }
  // Its first coordinates are equidistant, for any count.
  const SamplingPattern odd(PatternKind::Hammersley, 37, kKey);
  for (std::uint32_t i = 0; i < 37; ++i) EXPECT_NEAR(unshifted(odd, i, 0), i / 37., 1e-11);
}

TEST(SamplingPattern, HammersleyAndHaltonAreBalancedInBoxesOfTheirBases) {
  const auto check = [](PatternKind kind, std::uint32_t first, std::uint32_t second, std::uint32_t baseA,
                        std::uint32_t baseB, bool scrambled) {
    // Any run of a^i b^j points that starts at 0 has one in each of the a^i x b^j boxes.
    for (std::uint32_t columns = 1; columns <= 30; columns *= baseA) {
      for (std::uint32_t rows = 1; rows <= 30; rows *= baseB) {
        const SamplingPattern pattern(kind, 4096, kKey);
        const auto counts = boxCounts(columns * rows, columns, rows, [&](std::uint32_t i, std::uint32_t d) {
          const std::uint32_t dimension = d == 0 ? first : second;
          return scrambled ? pattern.value(i, dimension) : unshifted(pattern, i, dimension);
        });
        for (const int c : counts) {
          ASSERT_EQ(c, 1) << nameOf(kind) << ", bases " << baseA << ", " << baseB << ", " << columns << " x "
                          << rows;
        }
      }
    }
  };
  check(PatternKind::Halton, 0, 1, 2, 3, false);
  check(PatternKind::Halton, 1, 3, 3, 7, false);
  check(PatternKind::Hammersley, 1, 2, 2, 3, false);
  check(PatternKind::Hammersley, 2, 3, 3, 5, false);
  check(PatternKind::ScrambledHalton, 0, 1, 2, 3, true);
  check(PatternKind::ScrambledHalton, 2, 3, 5, 7, true);
}

TEST(SamplingPattern, IndependentPointsAreNoNet) {
  // Negative control of the balance above.
  const SamplingPattern pattern(PatternKind::Independent, 256, kKey);
  const auto counts =
      boxCounts(256, 16, 16, [&](std::uint32_t i, std::uint32_t d) { return pattern.value(i, d); });
  EXPECT_NE(counts, std::vector<int>(256, 1));
}

/// Warnock's formula for the square of the L2 star discrepancy of points in the unit square.
double squaredDiscrepancy(const SamplingPattern& pattern, std::uint32_t n) {
  std::vector<double> x(n), y(n);
  for (std::uint32_t i = 0; i < n; ++i) x[i] = pattern.value(i, 0), y[i] = pattern.value(i, 1);
  double single = 0, pairs = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    single += (1 - x[i] * x[i]) * (1 - y[i] * y[i]) / 4;
    for (std::uint32_t j = 0; j < n; ++j) pairs += (1 - std::max(x[i], x[j])) * (1 - std::max(y[i], y[j]));
  }
  return 1. / 9 - 2 * single / n + pairs / static_cast<double>(n) / n;
}

TEST(SamplingPattern, HasTheDiscrepancyOfItsKind) {
  // Independent points: E = (1/4 - 1/9) / n exactly. Latin hypercube: below that, still of order 1/n;
  // Hammersley and Halton: of order (log n)^2 / n^2.
  const std::uint32_t n = 256;
  const auto mean = [&](PatternKind kind) {
    test::RunningStats stats;
    for (std::uint64_t key = 0; key < 40; ++key)
      stats.add(squaredDiscrepancy(SamplingPattern(kind, n, key), n));
    return stats;
  };
  const double independent = (1. / 4 - 1. / 9) / n;
  const auto z = test::zTest(mean(PatternKind::Independent), independent, kKey);
  EXPECT_LT(std::abs(z.z()), test::kMaxAbsZ) << z;
  EXPECT_LT(mean(PatternKind::LatinHypercube).mean(), .5 * independent);
  for (const PatternKind kind :
       {PatternKind::Hammersley, PatternKind::Halton, PatternKind::ScrambledHalton}) {
    EXPECT_LT(mean(kind).mean(), .04 * independent) << nameOf(kind);
  }
}

TEST(SampleStream, TakesOneDimensionOfAPatternForEachDecision) {
  const SamplingPattern pattern(PatternKind::Halton, 8, kKey);
  Rng rng(1), untouched(1);
  SampleStream stream(rng, pattern, 5);
  EXPECT_EQ(stream.uniform(), pattern.value(5, 0));
  EXPECT_EQ(stream.uniformAboveZero(), 1 - pattern.value(5, 1));
  EXPECT_EQ(stream.exponential(), -std::log1p(-pattern.value(5, 2)));
  EXPECT_EQ(stream.uniform(), pattern.value(5, 3));
  EXPECT_EQ(rng.next(), untouched.next());
}

TEST(SampleStream, WithoutAPatternIsItsGenerator) {
  Rng rng(1), copy(1);
  SampleStream stream(rng);
  EXPECT_EQ(stream.uniform(), copy.uniformDouble());
  EXPECT_EQ(stream.uniformAboveZero(), 1 - copy.uniformDouble());
  EXPECT_EQ(stream.exponential(), copy.exponential());
}

}  // namespace
}  // namespace pbrtmedia
