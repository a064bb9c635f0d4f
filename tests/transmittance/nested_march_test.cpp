// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/nested_march.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "fields/canonical_line.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;
constexpr Comb kCombs[] = {Comb::Equidistant, Comb::Stratified, Comb::Independent, Comb::GoldenRatio};

std::vector<double> columnsOf(Comb comb, std::uint64_t teeth, unsigned splits, const CanonicalLine& line,
                              Rng& rng) {
  SampleStream stream(rng);
  LookupTally tally;
  std::vector<double> columns;
  NestedMarch(comb, teeth, splits)(line, stream, tally, [&](double column) { columns.push_back(column); });
  EXPECT_EQ(tally.lookups, teeth << splits);
  return columns;
}

/// Mean of the columns in [begin, begin + count).
double joined(const std::vector<double>& columns, std::size_t begin, std::size_t count) {
  double sum = 0;
  for (std::size_t i = begin; i < begin + count; ++i) sum += columns[i];
  return sum / static_cast<double>(count);
}

TEST(NestedMarch, HasOneToothPerStratumInPartsOfEverySize) {
  const auto function = *findCanonicalFunction("cosine");
  CanonicalLine line(function, {.length = 3});
  std::vector<double> points;
  line.record(&points);
  for (const Comb comb : {Comb::Equidistant, Comb::Stratified}) {
    for (const std::uint64_t teeth : {1u, 3u, 4u}) {
      constexpr unsigned kSplits = 5;
      Rng rng(kSeed);
      for (int repeat = 0; repeat < 20; ++repeat) {
        points.clear();
        columnsOf(comb, teeth, kSplits, line, rng);
        ASSERT_EQ(points.size(), teeth << kSplits);
        for (unsigned level = 0; level <= kSplits; ++level) {
          const std::size_t size = teeth << level;
          for (std::size_t begin = 0; begin < points.size(); begin += size) {
            std::set<std::size_t> strata;
            for (std::size_t i = begin; i < begin + size; ++i) {
              strata.insert(static_cast<std::size_t>(points[i] / line.length() * static_cast<double>(size)));
            }
            EXPECT_EQ(strata.size(), size) << "level " << level;
            EXPECT_LT(*strata.rbegin(), size);
          }
        }
      }
    }
  }
}

TEST(NestedMarch, HasEqualStepsInPartsOfEverySizeIfEquidistant) {
  const auto function = *findCanonicalFunction("cosine");
  CanonicalLine line(function, {.length = 2});
  std::vector<double> points;
  line.record(&points);
  Rng rng(kSeed);
  columnsOf(Comb::Equidistant, 3, 4, line, rng);
  for (unsigned level = 0; level <= 4; ++level) {
    const std::size_t size = std::size_t{3} << level;
    for (std::size_t begin = 0; begin < points.size(); begin += size) {
      const auto first = points.begin() + static_cast<std::ptrdiff_t>(begin);
      const std::multiset<double> part(first, first + static_cast<std::ptrdiff_t>(size));
      double before = *part.begin() - line.length() / static_cast<double>(size);
      for (const double s : part) {
        EXPECT_NEAR(s - before, line.length() / static_cast<double>(size), 1e-12);
        before = s;
      }
    }
  }
}

TEST(NestedMarch, HasPartsThatAreMarchesOfTheirSize) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {});
  const auto g = [](double column) { return std::exp(-3 * column); };
  for (const Comb comb : kCombs) {
    for (const std::uint64_t teeth : {1u, 2u, 3u}) {
      constexpr unsigned kSplits = 3;
      RunningStats parts[kSplits + 1], alone[kSplits + 1], squares[kSplits + 1], squaresAlone[kSplits + 1];
      Rng rng(kSeed), other(kSeed + 1);
      for (int repeat = 0; repeat < 5000; ++repeat) {
        const std::vector<double> columns = columnsOf(comb, teeth, kSplits, line, rng);
        for (unsigned level = 0; level <= kSplits; ++level) {
          const std::size_t count = std::size_t{1} << level;
          double sum = 0, sumOfSquares = 0;
          for (std::size_t begin = 0; begin < columns.size(); begin += count) {
            const double value = g(joined(columns, begin, count));
            sum += value;
            sumOfSquares += value * value;
          }
          const double share = static_cast<double>(count) / static_cast<double>(columns.size());
          parts[level].add(sum * share);
          squares[level].add(sumOfSquares * share);
          const double value = g(columnsOf(comb, teeth << level, 0, line, other)[0]);
          alone[level].add(value);
          squaresAlone[level].add(value * value);
        }
      }
      for (unsigned level = 0; level <= kSplits; ++level) {
        const auto test = zTest(parts[level], alone[level], kSeed);
        EXPECT_LT(std::abs(test.z()), kMaxAbsZ)
            << static_cast<int>(comb) << ", level " << level << ": " << test;
        const auto square = zTest(squares[level], squaresAlone[level], kSeed);
        EXPECT_LT(std::abs(square.z()), kMaxAbsZ) << static_cast<int>(comb) << ", squares: " << square;
      }
    }
  }
}

/// Negative control: odd and even strata of a jittered march are not two jittered marches of half the size.
TEST(NestedMarch, WouldBeBiasedByAnOddEvenSplitOfStrata) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {});
  RunningStats oddEven, nested, alone;
  Rng rng(kSeed), other(kSeed + 1);
  const auto g = [](double column) { return std::exp(-3 * column); };
  constexpr int kTeeth = 4;
  for (int repeat = 0; repeat < 40000; ++repeat) {
    double half[2] = {0, 0};
    for (int j = 0; j < 2 * kTeeth; ++j) {
      half[j & 1] += line.density((j + rng.uniformDouble()) / (2 * kTeeth)) / kTeeth;
    }
    oddEven.add((g(half[0]) + g(half[1])) / 2);
    const auto columns = columnsOf(Comb::Stratified, kTeeth, 1, line, rng);
    nested.add((g(columns[0]) + g(columns[1])) / 2);
    alone.add(g(columnsOf(Comb::Stratified, kTeeth, 0, line, other)[0]));
  }
  EXPECT_GT(std::abs(zTest(oddEven, alone).z()), kMaxAbsZ) << zTest(oddEven, alone, kSeed);
  EXPECT_LT(std::abs(zTest(nested, alone).z()), kMaxAbsZ) << zTest(nested, alone, kSeed);
}

TEST(NestedMarch, IntegratesWithoutBiasOverManyBatches) {
  const auto function = *findCanonicalFunction("gaussian");
  const CanonicalLine line(function, {.length = 2});
  Rng rng(kSeed);
  for (const Comb comb : kCombs) {
    for (const unsigned splits : {0u, 4u, 8u}) {
      RunningStats columns;
      for (int i = 0; i < 20; ++i) {
        const auto leaves = columnsOf(comb, 300, splits, line, rng);
        columns.add(joined(leaves, 0, leaves.size()));
      }
      const double rounding = 1e-6 * line.integral();
      EXPECT_LT(std::abs(columns.mean() - line.integral()), kMaxAbsZ * columns.standardError() + rounding);
      // Independent points: Var[f] = 1 / (2 sqrt(pi) sigma) - 1 = 4.64 at mean 1, sigma 0.05. 1.5: the noise
      // of a deviation from 20 values.
      const double points = 20.0 * 300 * std::pow(2, splits);
      EXPECT_LT(columns.standardError(), 2 * line.integral() * std::sqrt(4.64 / points) + rounding);
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
