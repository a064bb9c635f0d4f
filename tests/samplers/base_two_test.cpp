// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/base_two.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

std::vector<std::uint32_t> identity(std::uint32_t n) {
  std::vector<std::uint32_t> v(n);
  std::iota(v.begin(), v.end(), 0u);
  return v;
}

double value(std::uint32_t digits) { return reverseBits(digits) * 0x1p-32; }

TEST(ReverseBits, ReversesAndUndoesItself) {
  static_assert(reverseBits(1) == 0x80000000u && reverseBits(0x0f0u) == 0x0f000000u);
  EXPECT_EQ(reverseBits(reverseBits(0x12345678u)), 0x12345678u);
}

// Values by hand from m_k of the recurrence; x_(2^k) is the direction number m_(k+1) / 2^(k+1).
TEST(Sobol, StartsWithThePublishedDirectionNumbers) {
  const double expected[4][5] = {{1. / 2, 1. / 4, 1. / 8, 1. / 16, 1. / 32},
                                 {1. / 2, 3. / 4, 5. / 8, 15. / 16, 17. / 32},
                                 {1. / 2, 3. / 4, 3. / 8, 9. / 16, 29. / 32},
                                 {1. / 2, 3. / 4, 1. / 8, 5. / 16, 31. / 32}};
  for (int d = 0; d < 4; ++d) {
    EXPECT_EQ(sobolDigits(0, d), 0u);
    for (int k = 0; k < 5; ++k) EXPECT_EQ(value(sobolDigits(1u << k, d)), expected[d][k]) << d << ' ' << k;
    EXPECT_EQ(sobolDigits(13, d), sobolDigits(8, d) ^ sobolDigits(4, d) ^ sobolDigits(1, d));
  }
}

// m_k = 2 m_(k-1) xor m_(k-1): polynomial x + 1, the recurrence of the second dimension.
TEST(Sobol, SecondDimensionFollowsItsRecurrenceToTheLastBit) {
  std::uint64_t m = 1;
  for (int k = 0; k < 32; ++k) {
    EXPECT_EQ(reverseBits(sobolSecond(1u << k)), static_cast<std::uint32_t>(m << (31 - k))) << k;
    m ^= 2 * m;
  }
}

TEST(Sobol, EveryDimensionStratifiesAlignedBlocks) {
  for (int d = 0; d < 4; ++d) {
    for (const std::uint32_t first : {0u, 256u, 0xffffff00u}) {
      std::vector<bool> seen(256);
      for (std::uint32_t i = 0; i < 256; ++i) seen[reverseBits(sobolDigits(first + i, d)) >> 24] = true;
      EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 256) << d;
    }
  }
}

TEST(OwenScramble, IsNestedSoThatEqualPrefixesStayEqual) {
  for (std::uint64_t key = 0; key < 200; ++key) {
    for (int bits = 0; bits < 32; ++bits) {
      const std::uint32_t x = static_cast<std::uint32_t>(mix64(key * 977 + 1)), y = x ^ (1u << bits);
      const std::uint32_t difference = owenScramble(x, mix64(key)) ^ owenScramble(y, mix64(key));
      EXPECT_EQ(std::countr_zero(difference), bits);  // equal up to there, and certainly different there
    }
  }
}

/// Flips of the digit after two different prefixes of `bits` digits: independent and fair.
template <class Scramble>
double worstFlipZ(Scramble scramble, int bits, int prefixes) {
  constexpr int kKeys = 12000;
  double worst = 0;
  for (int p = 0; p < prefixes; ++p) {
    for (int q = 0; q <= p; ++q) {
      const std::uint32_t mask = (1u << bits) - 1;
      const std::uint32_t a =
          (1u << bits) <= 16u ? static_cast<std::uint32_t>(p) & mask
                              : static_cast<std::uint32_t>(subKey(1, static_cast<std::uint64_t>(p))) & mask;
      const std::uint32_t b =
          (1u << bits) <= 16u ? static_cast<std::uint32_t>(q) & mask
                              : static_cast<std::uint32_t>(subKey(1, static_cast<std::uint64_t>(q))) & mask;
      int count = 0;
      for (std::uint64_t t = 0; t < kKeys; ++t) {
        const std::uint64_t key = hashCombine(a, b, static_cast<std::uint64_t>(bits), t);
        const std::uint32_t flips = a == b ? scramble(a, key) : scramble(a, key) ^ scramble(b, key);
        count += (flips >> bits) & 1u;
      }
      worst = std::max(worst, std::abs(count - kKeys / 2.0) / std::sqrt(kKeys / 4.0));
    }
  }
  return worst;
}

TEST(OwenScramble, FlipsDigitsFairlyAndIndependentlyOfOtherPrefixes) {
  const auto scramble = [](std::uint32_t x, std::uint64_t key) { return owenScramble(x, key); };
  for (int bits = 1; bits <= 4; ++bits) EXPECT_LT(worstFlipZ(scramble, bits, 1 << bits), kMaxAbsZ) << bits;
  for (int bits = 5; bits <= 16; ++bits) EXPECT_LT(worstFlipZ(scramble, bits, 12), kMaxAbsZ) << bits;
}

TEST(OwenScramble, FlipTestRejectsAPlainExclusiveOr) {
  const auto flip = [](std::uint32_t x, std::uint64_t key) { return x ^ static_cast<std::uint32_t>(key); };
  EXPECT_GT(worstFlipZ(flip, 3, 8), kMaxAbsZ);
}

TEST(OwenShuffle, PermutesEveryBlockAndKeepsItsSubBlocksTogether) {
  for (std::uint64_t key = 1; key < 50; ++key) {
    for (const std::uint32_t first : {0u, 64u, 0xffffffc0u}) {
      std::vector<bool> seen(64);
      for (std::uint32_t i = 0; i < 64; ++i) {
        const std::uint32_t k = owenShuffle(first + i, 6, mix64(key));
        ASSERT_EQ(k & ~63u, first);
        seen[k & 63u] = true;
        ASSERT_EQ(k >> 3, owenShuffle(first + (i & ~7u), 6, mix64(key)) >> 3);
      }
      EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 64);
    }
  }
}

TEST(OwenShuffle, LeavesOneIndexAloneAndTakesAllThirtyTwoBits) {
  EXPECT_EQ(owenShuffle(77, 0, 5), 77u);
  EXPECT_NE(owenShuffle(1, 32, 5), owenShuffle(2, 32, 5));
}

TEST(OwenShuffle, ShufflesFurtherBlocksInOtherOrders) {
  int equal = 0;
  for (std::uint32_t i = 0; i < 256; ++i) equal += owenShuffle(i, 8, 9) + 256 == owenShuffle(256 + i, 8, 9);
  EXPECT_LT(equal, 32);
}

TEST(PrefixShuffle, MapsPrefixesAndBlocksToThemselves) {
  for (const std::uint32_t count : {1u, 2u, 3u, 16u, 23u, 100u, 256u}) {
    for (std::uint64_t key = 1; key < 30; ++key) {
      std::vector<std::uint32_t> first, later;
      for (std::uint32_t i = 0; i < count; ++i) {
        first.push_back(prefixShuffle(i, count, mix64(key)));
        later.push_back(prefixShuffle(7 * count + i, count, mix64(key)) - 7 * count);
        if (std::has_single_bit(i + 1) || i + 1 == count) {
          EXPECT_TRUE(std::is_permutation(first.begin(), first.end(), identity(i + 1).begin()))
              << count << ' ' << i;
        }
      }
      EXPECT_TRUE(std::is_permutation(later.begin(), later.end(), identity(count).begin())) << count;
    }
  }
}

TEST(PrefixShuffle, TakesTheLargestIndicesAndCounts) {
  EXPECT_GE(prefixShuffle((1u << 31) - 1, 1u << 31, 3), 1u << 30);
  EXPECT_GE(prefixShuffle(0xffffffffu, 1u << 31, 3), 1u << 31);
}

// Two slots: over keys, where the pairs of the last block go in one slot says nothing about the other.
TEST(PrefixShuffle, PlacesEverySampleOfABlockUniformly) {
  for (const std::uint32_t i : {16u, 21u, 31u}) {
    std::vector<double> counts(16);
    for (std::uint64_t t = 0; t < 20000; ++t) ++counts[prefixShuffle(i, 32, mix64(t)) - 16];
    EXPECT_GT(chiSquareUniform(counts).pValue(), kMinPValue) << i << ": " << chiSquareUniform(counts);
  }
}

TEST(PrefixShuffle, BreaksThePairsThatAnOwenShuffleKeeps) {
  const auto oppositeShare = [](auto shuffle) {
    int opposite = 0;
    for (std::uint64_t t = 0; t < 4000; ++t)
      opposite += (shuffle(32u, mix64(t)) ^ shuffle(33u, mix64(t))) & 1u;  // first digits of two samples
    return opposite / 4000.0;
  };
  EXPECT_EQ(oppositeShare([](std::uint32_t i, std::uint64_t k) { return owenShuffle(i, 6, k); }), 1.0);
  // 32 places: the partner is one of 31 others, of which 16 are opposite.
  EXPECT_NEAR(oppositeShare([](std::uint32_t i, std::uint64_t k) { return prefixShuffle(i, 64, k); }),
              16.0 / 31, kMaxAbsZ * 0.5 / std::sqrt(4000.0));
}

TEST(IndexBits, CountsTheBitsOfTheLastIndex) {
  EXPECT_EQ(indexBits(0), 0);
  EXPECT_EQ(indexBits(1), 0);
  EXPECT_EQ(indexBits(2), 1);
  EXPECT_EQ(indexBits(16), 4);
  EXPECT_EQ(indexBits(17), 5);
  EXPECT_EQ(indexBits(std::uint64_t{1} << 40), 32);
}

}  // namespace
}  // namespace pbrtmedia
