// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/order_roulette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/printed.h"
#include "support/statistics.h"
#include "transmittance/parts/comb_size.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::Printed;

TEST(OrderRoulette, HasTheExpectedOrdersOfTheClosedForm) {
  EXPECT_NEAR(OrderRoulette::bhanotKennedy(1).expectedOrder(), std::exp(1.) - 1, 1e-14);
  EXPECT_NEAR(OrderRoulette::bhanotKennedy(.5).expectedOrder(), std::exp(.5) - 1, 1e-14);
  // K + (e^c - sum_{k <= K} c^k/k!) K!/c^K
  EXPECT_NEAR(OrderRoulette::bhanotKennedy(2).expectedOrder(), 2 + (std::exp(2.) - 5) / 2, 1e-14);
  EXPECT_NEAR(OrderRoulette::bhanotKennedy(4).expectedOrder(),
              4 + (std::exp(4.) - (1 + 4 + 8 + 64 / 6. + 256 / 24.)) * 24 / 256, 1e-13);
  EXPECT_NEAR(OrderRoulette::aggressive(2, .9).expectedOrder(), .1 * (2 + (std::exp(2.) - 5) / 2), 1e-14);
  EXPECT_TRUE(Printed("0.31945").agreesWith(OrderRoulette::aggressive(2, .9).expectedOrder()));
  EXPECT_TRUE(Printed("0.031945").agreesWith(OrderRoulette::aggressive(2, .99).expectedOrder()));
  for (const auto& [c, printed] : {std::pair{.5, "0.6487"},
                                   {1., "1.71828"},
                                   {2., "3.19453"},
                                   {4., "5.89983"},
                                   {8., "10.919"},
                                   {16., "20.37"}}) {
    EXPECT_TRUE(Printed(printed).agreesWith(OrderRoulette::bhanotKennedy(c).expectedOrder())) << c;
  }
  EXPECT_EQ(OrderRoulette::truncated(3).expectedOrder(), 3.0);
  EXPECT_EQ(OrderRoulette::aggressive(2, 0).expectedOrder(), OrderRoulette::bhanotKennedy(2).expectedOrder());
}

TEST(OrderRoulette, OfTheCmfSpendsWhatPublishedImagesDid) {
  const struct {
    double depth;
    std::uint64_t certain;
    const char* lookups;
    double formula;  ///< N_CMF
  } rows[] = {{0.1, 2, "2.034", 2},      {0.5, 4, "4.109", 4},      {1, 5, "5.194", 5},
              {2, 7, "7.319", 7},        {2.302585, 7, "7.383", 8}, {5, 12, "12.588", 13},
              {10, 19, "19.926", 20},    {20, 32, "33.405", 33},    {50, 68, "70.370", 66},
              {100, 125, "128.440", 118}};
  for (const auto& row : rows) {
    const OrderRoulette roulette = OrderRoulette::cmf(row.depth);
    EXPECT_EQ(roulette.certain, row.certain) << row.depth;
    EXPECT_TRUE(Printed(row.lookups).agreesWith(roulette.expectedOrder()))
        << row.depth << ": " << roulette.expectedOrder();
    EXPECT_EQ(pSeriesCmfLookups(row.depth), row.formula) << row.depth;
  }
  EXPECT_EQ(OrderRoulette::cmf(0).certain, 1u);
  EXPECT_EQ(OrderRoulette::cmf(0).expectedOrder(), 1.0);
}

TEST(CombSize, FollowsTheFormulaOfThePaper) {
  EXPECT_EQ(pSeriesCmfLookups(0), 1.0);
  EXPECT_EQ(pSeriesCmfLookups(1), 5.0);
  EXPECT_EQ(pSeriesCmfLookups(10), 20.0);
  const double expected = OrderRoulette::aggressive(2, .9).expectedOrder();
  EXPECT_EQ(tupleSizeFor(0, expected, 0), 1u);
  EXPECT_EQ(tupleSizeFor(1, expected, 0), 4u);
  EXPECT_EQ(tupleSizeFor(10, expected, 0), 15u);
  EXPECT_EQ(tupleSizeFor(10, expected, 7), 7u);
  // M of the tables of unbiased ray marching.
  for (const auto& [depth, teeth] : {std::pair{.1109, 2ull},
                                     {.7296, 3ull},
                                     {1.459, 5ull},
                                     {4.847, 10ull},
                                     {5.776, 11ull},
                                     {19.19, 24ull},
                                     {3.234, 8ull},
                                     {51.75, 52ull}}) {
    EXPECT_EQ(tupleSizeFor(depth, expected, 0), teeth) << depth;
  }
  EXPECT_NEAR(pSeriesCmfLookups(1e6), 1e6 + 20, 2);
  EXPECT_EQ(tupleSizeFor(1e300, expected, 0), 1ull << 32);
  EXPECT_EQ(teethOf(0, 0), 1u);
}

TEST(CombSize, StaysNearTheTrueCostOfPSeriesCmf) {
  double sum = 0, worst = 0;
  for (int i = 0; i < 10000; ++i) {
    const double depth = (i + .5) / 1000;
    sum += std::abs(pSeriesCmfLookups(depth) - OrderRoulette::cmf(depth).expectedOrder());
  }
  for (double depth = 10; depth <= 500; depth += .5) {
    worst =
        std::max(worst, std::abs(pSeriesCmfLookups(depth) / OrderRoulette::cmf(depth).expectedOrder() - 1));
  }
  EXPECT_NEAR(sum / 10000, .342, .002);
  EXPECT_NEAR(worst, .0905, .002);
}

TEST(OrderRoulette, DrawsEachOrderWithItsProbability) {
  for (const OrderRoulette roulette :
       {OrderRoulette::aggressive(2, .9), OrderRoulette::bhanotKennedy(.7), OrderRoulette::bhanotKennedy(3.5),
        OrderRoulette::aggressive(.5, .3), OrderRoulette::cmf(2), OrderRoulette::truncated(2.5)}) {
    // P_k is where draw() steps from below k to k and more, to the last bit or two.
    double reached = 1;
    for (std::uint64_t k = 1; k <= 20; ++k) {
      reached *= roulette.continuation(k);
      if (reached > 0) {
        EXPECT_GE(roulette.draw(reached * (1 - 1e-14)), k);
      }
      if (reached < 1) {
        EXPECT_LT(roulette.draw(std::min(1.0, reached * (1 + 1e-14) + 1e-300)), k);
      }
    }
    Rng rng(5);
    test::RunningStats orders;
    for (int i = 0; i < 100000; ++i) {
      orders.add(static_cast<double>(roulette.draw(1 - rng.uniformDouble())));
    }
    const auto test = test::zTest(orders, roulette.expectedOrder(), 5);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  }
}

TEST(OrderRoulette, EndsForTheSmallestAndTheLargestNumber) {
  for (const double c : {1e-9, 1., 2., 170.5, 1e6}) {
    const OrderRoulette roulette = OrderRoulette::bhanotKennedy(c);
    EXPECT_GE(roulette.draw(0x1p-53), roulette.draw(1));
    EXPECT_EQ(roulette.draw(1), roulette.certain);
    EXPECT_LT(roulette.draw(0x1p-53), c + 20 * std::sqrt(c) + 40);
    EXPECT_TRUE(std::isfinite(roulette.expectedOrder()));
  }
  EXPECT_EQ(OrderRoulette::bhanotKennedy(0).draw(1e-300), 0u);
}

TEST(OrderRoulette, WeighsTermsByTheInverseOfFactorialAndProbability) {
  const OrderRoulette roulette = OrderRoulette::aggressive(2, .9);
  // k! P_k = K! c^(k-K) (1 - p_Z).
  double weight = 1;
  for (std::uint64_t k = 1; k <= 30; ++k) {
    weight *= roulette.termFactor(k);
    const double expected = k <= 2 ? std::tgamma(static_cast<double>(k) + 1) * .1
                                   : 2 * std::pow(2., static_cast<double>(k) - 2) * .1;
    EXPECT_NEAR(weight * expected, 1, 1e-13) << k;
  }
}

}  // namespace
}  // namespace pbrtmedia
