// SPDX-License-Identifier: BSD-2-Clause
#include "base/rng.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

// xoshiro256++ written down a second time from the paper's description, on an array.
TEST(Rng, FollowsTheRecurrenceOfXoshiro256PlusPlus) {
  std::uint64_t seed = 42, s[4];
  for (std::uint64_t& w : s) w = mix64(seed += 0x9e3779b97f4a7c15ull);
  Rng rng(42);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t sum = s[0] + s[3], expected = ((sum << 23) | (sum >> 41)) + s[0], t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = (s[3] << 45) | (s[3] >> 19);
    EXPECT_EQ(rng.next(), expected);
  }
}

TEST(Rng, RepeatsItselfAndCopiesReplay) {
  Rng a(7), b(7), c(8);
  EXPECT_EQ(a.next(), b.next());
  EXPECT_NE(a.next(), c.next());
  Rng copy = a;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(copy.next(), a.next());
}

TEST(Rng, UniformNumbersStayBelowOneAndFillTheInterval) {
  Rng rng(1);
  std::vector<double> f, d;
  for (int i = 0; i < 100000; ++i) {
    f.push_back(rng.uniform());
    d.push_back(rng.uniformDouble());
    ASSERT_LT(f.back(), 1.0);
    ASSERT_LT(d.back(), 1.0);
    ASSERT_GE(f.back(), 0.0);
    ASSERT_EQ(f.back() * 0x1p24, std::floor(f.back() * 0x1p24));
  }
  EXPECT_GT(ksTestUniform(f).pValue(), kMinPValue) << ksTestUniform(f);
  EXPECT_GT(ksTestUniform(d).pValue(), kMinPValue) << ksTestUniform(d);
}

TEST(Rng, IntegersAreUniformAndBelowTheirBound) {
  Rng rng(2);
  EXPECT_EQ(rng.uniformInt(1), 0u);
  for (const std::uint32_t n : {2u, 7u, 100u}) {
    std::vector<double> counts(n);
    for (int i = 0; i < 50000; ++i) {
      const std::uint32_t k = rng.uniformInt(n);
      ASSERT_LT(k, n);
      ++counts[k];
    }
    EXPECT_GT(chiSquareUniform(counts).pValue(), kMinPValue) << chiSquareUniform(counts);
  }
  EXPECT_LT(rng.uniformInt(0xffffffffu), 0xffffffffu);
}

TEST(Rng, ExponentialVariatesFollowTheirLaw) {
  Rng rng(3);
  std::vector<double> v(100000);
  for (double& x : v) {
    x = rng.exponential();
    ASSERT_GT(x, 0.0);
    ASSERT_TRUE(std::isfinite(x));
  }
  const KsTest test = ksTest(v, [](double x) { return -std::expm1(-x); });
  EXPECT_GT(test.pValue(), kMinPValue) << test;
}

TEST(Rng, ExponentialLawIsNotTakenForAnother) {
  Rng rng(3);
  std::vector<double> v(100000);
  for (double& x : v) x = 1.05 * rng.exponential();
  EXPECT_LT(ksTest(v, [](double x) { return -std::expm1(-x); }).pValue(), kMinPValue);
}

// Streams of neighbouring seeds, as pixels use them, have nothing in common.
TEST(Rng, NeighbouringSeedsGiveIndependentStreams) {
  std::vector<double> pairs(64), first(64);
  for (std::uint64_t seed = 0; seed < 40000; ++seed) {
    Rng a(seed), b(seed + 1);
    const std::uint32_t x = a.uniformInt(8), y = b.uniformInt(8);
    ++pairs[x * 8 + y];
    ++first[Rng(seed).uniformInt(64)];
  }
  EXPECT_GT(chiSquareUniform(pairs).pValue(), kMinPValue) << chiSquareUniform(pairs);
  EXPECT_GT(chiSquareUniform(first).pValue(), kMinPValue) << chiSquareUniform(first);
}

}  // namespace
}  // namespace pbrtmedia
