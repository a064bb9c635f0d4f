// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "samplers/all_samplers.h"
#include "samplers/radical_inverse.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

template <std::uint32_t kBase>
void expectStratified(std::uint64_t first, int cells, std::uint64_t key) {
  std::vector<Point2f> points;
  for (int i = 0; i < cells; ++i)
    points.push_back({scrambledRadicalInverse<kBase>(first + static_cast<std::uint64_t>(i), 300, key), 0});
  EXPECT_TRUE(oneInEachCell(points, cells, 1)) << kBase << ' ' << cells << ' ' << key;
}

TEST(ScrambledRadicalInverse, FillsEachIntervalOnceInAnyRunOfAPowerOfItsBase) {
  for (std::uint64_t key = 0; key < 50; ++key) {
    for (const std::uint64_t first : {0u, 1u, 17u}) {
      expectStratified<3>(first, 9, mix64(key));
      expectStratified<3>(first, 27, mix64(key));
      expectStratified<5>(first, 125, mix64(key));
      expectStratified<7>(first, 49, mix64(key));
    }
  }
}

TEST(ScrambledRadicalInverse, IsUniformAndPairwiseStratifiedOverKeys) {
  // Indices 4 and 13 agree in two digits of base 3 (4 = 11, 13 = 111): their third digits must differ.
  std::vector<double> values, thirds(9), expected(9, 30000.0 / 6);
  for (std::size_t d = 0; d < 3; ++d) expected[4 * d] = 0;
  for (std::uint64_t t = 0; t < 30000; ++t) {
    const std::uint64_t key = hashCombine(3, t);
    const float a = scrambledRadicalInverse<3>(4, 27, key), b = scrambledRadicalInverse<3>(13, 27, key);
    values.push_back(a);
    const auto cellA = static_cast<std::size_t>(double{a} * 27),
               cellB = static_cast<std::size_t>(double{b} * 27);
    ASSERT_EQ(cellA / 3, cellB / 3);
    ++thirds[(cellA % 3) * 3 + cellB % 3];
  }
  EXPECT_GT(ksTestUniform(values).pValue(), kMinPValue) << ksTestUniform(values);
  EXPECT_GT(chiSquareTest(thirds, expected).pValue(), kMinPValue) << chiSquareTest(thirds, expected);
}

TEST(ScrambledRadicalInverse, TakesTheLargestIndices) {
  const std::uint64_t last = ~std::uint64_t{0};
  const float a = scrambledRadicalInverse<3>(last, last, 1),
              b = scrambledRadicalInverse<3>(last - 1, last, 1);
  EXPECT_TRUE(a >= 0 && a < 1 && b >= 0 && b < 1);
  EXPECT_NE(a, b);
}

TEST(Halton, FirstDimensionOfAPairStratifiesPowersOfTwo) {
  HaltonSampler s({.pixelSamples = 64});
  for (const int slot : {0, 1, 9}) {
    for (int n = 1; n <= 64; n *= 2)
      EXPECT_TRUE(oneInEachCell(slotPoints(s, {3, 4}, slot, 0, n), n, 1)) << slot;
  }
}

TEST(Halton, ConsecutiveRunsCoverTheSecondDimensionOfAPair) {
  // The first 32 indices are consecutive: three runs of 9 and 5 more, each in another ninth.
  HaltonSampler s({.pixelSamples = 32});
  for (const int slot : {0, 1, 9}) {
    std::vector<int> ninths(9);
    for (const Point2f p : slotPoints(s, {3, 4}, slot, 0, 32)) ++ninths[static_cast<std::size_t>(p.y * 9)];
    for (const int n : ninths) EXPECT_TRUE(n == 3 || n == 4) << n;
  }
}

TEST(Halton, FillsTheGridOfItsBasesWhenTheCountIsAMultiple) {
  HaltonSampler s({.pixelSamples = 36});
  for (const int slot : {0, 1, 9}) {
    EXPECT_TRUE(oneInEachCell(slotPoints(s, {3, 4}, slot, 0, 36), 4, 9)) << slot;
    EXPECT_TRUE(oneInEachCell(slotPoints(s, {3, 4}, slot, 36, 36), 4, 9)) << slot;
  }
}

TEST(Halton, AnyNumberOfSamplesBeatsRandom) {
  for (const int n : {3, 6, 10, 24, 50}) {
    HaltonSampler s({.pixelSamples = n});
    for (const int slot : {0, 3}) {
      RunningStats means;
      for (int p = 0; p < 1000; ++p) {
        double sum = 0;
        for (const Point2f q : slotPoints(s, {p, 5}, slot, 0, n)) sum += q.x + q.y;
        means.add(sum / n);
      }
      EXPECT_LT(means.variance() * n, 0.6 / 6) << n;  // random: 1/12 + 1/12
      EXPECT_LT(std::abs(zTest(means, 1).z()), kMaxAbsZ) << zTest(means, 1);
    }
  }
}

TEST(Halton, PixelCentresPinTheFilmAndLeaveTheRestAlone) {
  HaltonSampler free({}), pinned({.samplePixelCentre = true});
  free.start({3, 4}, 5);
  pinned.start({3, 4}, 5);
  const CameraSample a = free.cameraSample({3, 4}), b = pinned.cameraSample({3, 4});
  EXPECT_EQ(b.film, (Point2f{3.5f, 4.5f}));
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.lens, b.lens);
  EXPECT_EQ(free.get1D(), pinned.get1D());
  const auto copy = pinned.clone();
  copy->start({3, 4}, 6);
  EXPECT_EQ(copy->cameraSample({3, 4}).film, (Point2f{3.5f, 4.5f}));
}

}  // namespace
}  // namespace pbrtmedia
