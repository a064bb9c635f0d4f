// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/hashed_permutation.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

TEST(HashedPermutation, IsABijectionForEverySizeAndKey) {
  for (const std::uint32_t n : {1u, 2u, 3u, 7u, 15u, 16u, 17u, 18u, 31u, 64u, 100u, 1000u, 4097u}) {
    const HashedPermutation p(n);
    EXPECT_EQ(p.size(), n);
    for (const std::uint64_t key : {std::uint64_t{0}, std::uint64_t{12345}, ~std::uint64_t{0}}) {
      std::vector<bool> seen(n);
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t k = p(i, key);
        ASSERT_LT(k, n);
        ASSERT_FALSE(seen[k]);
        seen[k] = true;
      }
    }
  }
}

TEST(HashedPermutation, WorksAtTheLargestSize) {
  const HashedPermutation p(1u << 31);
  EXPECT_LT(p((1u << 31) - 1, 5), 1u << 31);
  EXPECT_NE(p(0, 5), p(1, 5));
}

/// Places of the pair (i, k) over many keys, against all pairs of different places equally often.
template <class Permute>
ChiSquareTest pairTest(Permute permute, std::uint32_t n, std::uint32_t i, std::uint32_t k, int keys) {
  std::vector<double> counts(n * n), expected(n * n, keys / (double{1} * n * (n - 1)));
  for (std::uint32_t d = 0; d < n; ++d) expected[d * n + d] = 0;
  for (int t = 0; t < keys; ++t) {
    const std::uint64_t key = hashCombine(n, i, k, static_cast<std::uint64_t>(t));
    ++counts[permute(i, key) * n + permute(k, key)];
  }
  return chiSquareTest(counts, expected);
}

TEST(HashedPermutation, SendsPairsToAllPairsEquallyOften) {
  for (const std::uint32_t n : {3u, 4u, 9u, 16u, 17u, 25u, 32u, 36u, 64u}) {
    const HashedPermutation p(n);
    for (const auto& [i, k] : {std::pair{0u, 1u}, std::pair{0u, n - 1}, std::pair{n / 2, n - 1}}) {
      if (i == k) continue;
      const ChiSquareTest test = pairTest(p, n, i, k, 100000);
      EXPECT_GT(test.pValue(), sidak(kMinPValue, 30)) << n << ' ' << i << ' ' << k << ": " << test;
    }
  }
}

TEST(HashedPermutation, PairTestRejectsARandomRotation) {
  const auto rotate = [](std::uint32_t i, std::uint64_t key) {
    return static_cast<std::uint32_t>((i + key % 16) % 16);
  };
  EXPECT_LT(pairTest(rotate, 16, 0, 1, 100000).pValue(), kMinPValue);
}

// All orders, not only all pairs: 24 permutations of four.
TEST(HashedPermutation, TakesEveryOrderOfFourEquallyOften) {
  const HashedPermutation p(4);
  std::vector<double> counts(256), expected(256);
  for (std::uint64_t key = 0; key < 24000; ++key) {
    std::size_t code = 0;
    for (std::uint32_t i = 0; i < 4; ++i) code = code * 4 + p(i, mix64(key + 1));
    ++counts[code];
  }
  for (std::size_t c = 0; c < 256; ++c) {
    const std::size_t a = c >> 6, b = (c >> 4) & 3, d = (c >> 2) & 3, e = c & 3;
    expected[c] = (a != b && a != d && a != e && b != d && b != e && d != e) ? 1000 : 0;
  }
  const ChiSquareTest test = chiSquareTest(counts, expected);
  EXPECT_GT(test.pValue(), kMinPValue) << test;
}

}  // namespace
}  // namespace pbrtmedia
