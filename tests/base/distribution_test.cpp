// SPDX-License-Identifier: BSD-2-Clause
#include "base/distribution.h"

#include <gtest/gtest.h>

#include "base/math.h"
#include "base/rng.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

const std::vector<float> kWeights{1, 0, 3, 0, 0, 4, 0};

TEST(Distribution1D, KnowsItsProbabilitiesAndIntegral) {
  const Distribution1D d(kWeights);
  EXPECT_EQ(d.size(), 7u);
  EXPECT_DOUBLE_EQ(d.integral(), 8.0 / 7);
  EXPECT_FLOAT_EQ(d.probability(0), 1.0f / 8);
  EXPECT_EQ(d.probability(1), 0.0f);
  EXPECT_FLOAT_EQ(d.probability(5), 0.5f);
  EXPECT_FLOAT_EQ(d.pdf(0.01f), 7.0f / 8);
  EXPECT_FLOAT_EQ(d.pdf(5.5f / 7), 3.5f);
  EXPECT_EQ(d.pdf(1.0f), 0.0f);  // the last element
}

TEST(Distribution1D, NeverTakesAnElementOfWeightZero) {
  const Distribution1D d(kWeights);
  for (const float u :
       {0.0f, 0.125f, std::nextafter(0.125f, 0.0f), 0.5f, std::nextafter(0.5f, 0.0f), kOneMinusEpsilon}) {
    const auto c = d.choose(u);
    EXPECT_GT(kWeights[c.index], 0.0f) << u;
    EXPECT_GT(c.probability, 0.0f) << u;
    EXPECT_GE(c.remapped, 0.0f);
    EXPECT_LT(c.remapped, 1.0f);
  }
  EXPECT_EQ(d.choose(0.125f).index, 2u);
  EXPECT_EQ(d.choose(kOneMinusEpsilon).index, 5u);
  const Distribution1D leading(std::vector<float>{0, 0, 1});
  EXPECT_EQ(leading.choose(0).index, 2u);
}

TEST(Distribution1D, IsUniformWhenAllWeightsAreZero) {
  const Distribution1D d(std::vector<float>{0, 0, 0, 0});
  EXPECT_EQ(d.integral(), 0.0);
  EXPECT_EQ(d.choose(0.6f).index, 2u);
  EXPECT_EQ(d.pdf(0.1f), 1.0f);
}

TEST(Distribution1D, OfOneElementIsTheUniformNumberItself) {
  const Distribution1D d(std::vector<float>{5});
  for (const float u : {0.0f, 0.25f, 0.7f, kOneMinusEpsilon}) {
    EXPECT_EQ(d.sample(u).x, u);
    EXPECT_EQ(d.sample(u).pdf, 1.0f);
  }
}

TEST(Distribution1D, ChoosesInProportionAndRemapsUniformly) {
  const Distribution1D d(kWeights);
  Rng rng(1);
  constexpr int kN = 100000;
  std::vector<double> counts(7), expected(7), remapped;
  for (int i = 0; i < kN; ++i) {
    const auto c = d.choose(rng.uniform());
    ++counts[c.index];
    remapped.push_back(c.remapped);
  }
  for (std::size_t i = 0; i < 7; ++i) expected[i] = kN * kWeights[i] / 8.0;
  const ChiSquareTest chi = chiSquareTest(counts, expected);
  EXPECT_GT(chi.pValue(), kMinPValue) << chi;
  const KsTest ks = ksTestUniform(remapped);
  EXPECT_GT(ks.pValue(), kMinPValue) << ks;
}

// A sample on the rounded edge of its element must not see its neighbour's density.
TEST(Distribution1D, DensityAtASampleIsTheDensityOfTheSample) {
  Rng rng(2);
  for (const std::size_t n : {3u, 7u, 1000u, 1021u, 4096u, 100003u}) {
    std::vector<float> weights(n);
    for (float& w : weights) w = rng.uniform() < 0.5f ? 0.0f : rng.uniform();
    const Distribution1D d(weights);
    std::vector<float> us{0, kOneMinusEpsilon};
    double sum = 0, total = 0;
    for (const float w : weights) total += w;
    for (std::size_t i = 0; i < n; ++i) {  // both sides of every edge
      const float edge = std::min(static_cast<float>(sum / total), kOneMinusEpsilon);
      us.insert(us.end(),
                {edge, std::nextafter(edge, 0.0f), std::min(std::nextafter(edge, 1.0f), kOneMinusEpsilon)});
      sum += weights[i];
    }
    for (const float u : us) {
      const auto s = d.sample(u);
      ASSERT_GE(s.x, 0.0f);
      ASSERT_LT(s.x, 1.0f);
      ASSERT_EQ(d.pdf(s.x), s.pdf) << "n " << n << " u " << u << " x " << s.x;
      ASSERT_GT(s.pdf, 0.0f);
    }
  }
}

TEST(Distribution1D, DensityIntegratesToOne) {
  const Distribution1D d(kWeights);
  double sum = 0;
  for (int i = 0; i < 7000; ++i) sum += d.pdf((static_cast<float>(i) + 0.5f) / 7000);
  EXPECT_NEAR(sum / 7000, 1, 1e-6);
}

TEST(Distribution1D, HoldsWeightsOfVeryDifferentSize) {
  const Distribution1D d(std::vector<float>{1e30f, 1e-30f, 1e30f});
  EXPECT_FLOAT_EQ(d.probability(0), 0.5f);
  EXPECT_EQ(d.choose(0.5f).index, 2u);
}

TEST(Distribution2D, SamplesInProportionToItsCells) {
  const std::vector<float> w{1, 2, 0, 0, 0, 0, 3, 0, 4};  // 3 x 3, the middle row is empty
  const Distribution2D d(w, 3, 3);
  Rng rng(3);
  constexpr int kN = 100000;
  std::vector<double> counts(9), expected(9);
  for (int i = 0; i < kN; ++i) {
    const float u = rng.uniform(), v = rng.uniform();
    const auto s = d.sample({u, v});
    EXPECT_NEAR(d.pdf(s.p), s.pdf, 1e-5f * s.pdf);
    const auto cell = static_cast<std::size_t>(s.p.y * 3) * 3 + static_cast<std::size_t>(s.p.x * 3);
    ++counts[cell];
    EXPECT_NEAR(s.pdf, w[cell] * 9 / 10, 1e-5);
  }
  for (std::size_t i = 0; i < 9; ++i) expected[i] = kN * w[i] / 10.0;
  const ChiSquareTest chi = chiSquareTest(counts, expected);
  EXPECT_GT(chi.pValue(), kMinPValue) << chi;
}

TEST(Distribution2D, HasDensityZeroInEmptyCellsAndClampsAtTheBorder) {
  const Distribution2D d(std::vector<float>{1, 0, 0, 1}, 2, 2);
  EXPECT_EQ(d.pdf({0.75f, 0.25f}), 0.0f);
  EXPECT_FLOAT_EQ(d.pdf({0.25f, 0.25f}), 2.0f);
  EXPECT_FLOAT_EQ(d.pdf({1.0f, 1.0f}), 2.0f);
}

TEST(Distribution2D, IsUniformWhenAllWeightsAreZero) {
  const Distribution2D d(std::vector<float>(6, 0.0f), 3, 2);
  EXPECT_FLOAT_EQ(d.pdf({0.1f, 0.9f}), 1.0f);
  EXPECT_FLOAT_EQ(d.sample({0.5f, 0.5f}).pdf, 1.0f);
}

}  // namespace
}  // namespace pbrtmedia
