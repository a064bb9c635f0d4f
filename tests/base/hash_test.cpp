// SPDX-License-Identifier: BSD-2-Clause
#include "base/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "base/rng.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

// Flipping any input bit flips each output bit in half of the cases.
template <class Hash>
double worstAvalancheZ(Hash hash) {
  constexpr int kInputs = 4000;
  double worst = 0;
  for (int bit = 0; bit < 64; ++bit) {
    std::array<int, 64> flips{};
    Rng rng(static_cast<std::uint64_t>(bit));  // inputs of which none is another one with the bit flipped
    for (int k = 0; k < kInputs; ++k) {
      const std::uint64_t i = rng.next();
      std::uint64_t change = hash(i) ^ hash(i ^ (std::uint64_t{1} << bit));
      for (; change != 0; change &= change - 1) ++flips[static_cast<std::size_t>(std::countr_zero(change))];
    }
    for (const int n : flips) worst = std::max(worst, std::abs(n - kInputs / 2.0) / std::sqrt(kInputs / 4.0));
  }
  return worst;
}

TEST(Mix64, IsABijectionOnSmallNumbersAtLeast) {
  std::vector<std::uint64_t> v(1 << 18);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = mix64(i);
  std::sort(v.begin(), v.end());
  EXPECT_EQ(std::adjacent_find(v.begin(), v.end()), v.end());
  EXPECT_EQ(mix64(0), 0u);
}

TEST(HashCombine, EveryInputBitReachesEveryOutputBit) {
  EXPECT_LT(worstAvalancheZ([](std::uint64_t x) { return hashCombine(x); }), test::kMaxAbsZ);
  EXPECT_LT(worstAvalancheZ([](std::uint64_t x) { return hashCombine(7, x); }), test::kMaxAbsZ);
  EXPECT_LT(worstAvalancheZ([](std::uint64_t x) { return hashCombine(7, x, 9); }), test::kMaxAbsZ);
}

TEST(HashCombine, AvalancheTestRejectsAPlainProduct) {
  EXPECT_GT(worstAvalancheZ([](std::uint64_t x) { return x * 0x9e3779b97f4a7c15ull; }), 20.0);
}

TEST(HashCombine, DependsOnOrderAndCount) {
  EXPECT_NE(hashCombine(1, 2), hashCombine(2, 1));
  EXPECT_NE(hashCombine(1, 2, 3), hashCombine(1, 3, 2));
  EXPECT_NE(hashCombine(1), hashCombine(1, 0));
  EXPECT_NE(hashCombine(1, 0), hashCombine(1, 0, 0));
}

TEST(HashCombine, DoesNotCollideOnAGridOfPixels) {
  std::vector<std::uint64_t> v;
  for (std::uint64_t x = 0; x < 512; ++x) {
    for (std::uint64_t y = 0; y < 512; ++y) v.push_back(hashCombine(0, x, y));
  }
  std::sort(v.begin(), v.end());
  EXPECT_EQ(std::adjacent_find(v.begin(), v.end()), v.end());
}

TEST(HashBytes, TellsStringsApartAndWorksAtCompileTime) {
  static_assert(hashBytes("smoke") != hashBytes("Smoke"));
  EXPECT_NE(hashBytes(""), hashBytes(std::string_view("\0", 1)));
  EXPECT_NE(hashBytes("ab"), hashBytes("ba"));
  EXPECT_EQ(hashBytes("ab", 5), hashBytes("ab", 5));
  EXPECT_NE(hashBytes("ab", 5), hashBytes("ab", 6));
}

}  // namespace
}  // namespace pbrtmedia
