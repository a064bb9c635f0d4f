// SPDX-License-Identifier: BSD-2-Clause
#include "fields/sample_layout.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

namespace pbrtmedia {
namespace {

class SampleLayoutTest : public testing::TestWithParam<std::tuple<int, int, int, GridLayout>> {
 protected:
  const std::int64_t nx = std::get<0>(GetParam()), ny = std::get<1>(GetParam()), nz = std::get<2>(GetParam());
  const SampleLayout layout{nx, ny, nz, std::get<3>(GetParam()), sizeof(float)};
};

TEST_P(SampleLayoutTest, HoldsTheEightSamplesOfEveryCellAtFixedDistances) {
  // What eachRun stores where; a place may be written once only.
  std::map<std::int64_t, std::tuple<std::int64_t, std::int64_t, std::int64_t>> sampleAt;
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      layout.eachRun(j, k, [&](std::int64_t first, std::int64_t count, std::int64_t at) {
        for (std::int64_t i = 0; i < count; ++i) {
          ASSERT_TRUE(sampleAt.emplace(at + i, std::tuple(first + i, j, k)).second);
          ASSERT_LT(at + i, layout.stored());
        }
      });
    }
  }
  for (std::int64_t k = 0; k + 1 < nz; ++k) {
    for (std::int64_t j = 0; j + 1 < ny; ++j) {
      for (std::int64_t i = 0; i + 1 < nx; ++i) {
        const std::int64_t at = layout.index(i, j, k);
        for (int corner = 0; corner < 8; ++corner) {
          const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
          ASSERT_EQ(sampleAt.at(at + x + y * layout.row() + z * layout.slice()),
                    std::tuple(i + x, j + y, k + z));
        }
      }
    }
  }
}

TEST_P(SampleLayoutTest, FindsEverySampleTheLastOnesIncluded) {
  std::set<std::int64_t> seen;
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      std::map<std::int64_t, std::set<std::int64_t>> places;  // of each sample of the row
      layout.eachRun(j, k, [&](std::int64_t first, std::int64_t count, std::int64_t at) {
        for (std::int64_t i = 0; i < count; ++i) places[first + i].insert(at + i);
      });
      for (std::int64_t i = 0; i < nx; ++i) {
        ASSERT_TRUE(places[i].count(layout.index(i, j, k))) << i << ' ' << j << ' ' << k;
        ASSERT_TRUE(seen.insert(layout.index(i, j, k)).second);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ShapesAndLayouts, SampleLayoutTest,
                         testing::Combine(testing::Values(2, 9, 18), testing::Values(3, 10),
                                          testing::Values(2, 8, 17),
                                          testing::Values(GridLayout::Linear, GridLayout::Bricked)));

TEST(SampleLayout, CountsBeyondThirtyTwoBits) {
  const SampleLayout linear(3000, 2000, 1000, GridLayout::Linear, sizeof(float));
  EXPECT_EQ(linear.stored(), 6'000'000'000);
  EXPECT_EQ(linear.index(2999, 1999, 999), 5'999'999'999);
  const SampleLayout bricked(3000, 2000, 1000, GridLayout::Bricked, sizeof(float));
  EXPECT_EQ(bricked.stored(), std::int64_t{375} * 250 * 125 * 736);
  // The last sample of the last brick: 2999 = 374 * 8 + 7 and so on.
  EXPECT_EQ(bricked.index(2999, 1999, 999),
            ((std::int64_t{124} * 250 + 249) * 375 + 374) * 736 + (7 * 9 + 7) * 9 + 7);
}

TEST(SampleLayout, ChoosesBricksForLargeGridsThatAreNotThin) {
  const auto isBricked = [](std::int64_t nx, std::int64_t ny, std::int64_t nz, std::size_t bytes) {
    return SampleLayout(nx, ny, nz, GridLayout::Automatic, bytes).isBricked();
  };
  EXPECT_FALSE(isBricked(102, 102, 42, 4));
  EXPECT_FALSE(isBricked(162, 162, 162, 4));
  EXPECT_TRUE(isBricked(258, 258, 258, 4));
  EXPECT_TRUE(isBricked(258, 258, 258, 2));
  EXPECT_FALSE(isBricked(202, 202, 202, 2));
  EXPECT_FALSE(isBricked(40000, 1000, 3, 4));  // bricks would hold 8 cells for each 2
}

TEST(SampleLayout, CostsTheMemoryItStates) {
  const SampleLayout bricked(257, 257, 257, GridLayout::Bricked, sizeof(float));
  EXPECT_EQ(bricked.stored(), 32 * 32 * 32 * 736);
}

}  // namespace
}  // namespace pbrtmedia
