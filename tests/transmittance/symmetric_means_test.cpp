// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/symmetric_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

__extension__ typedef __int128 Wide;  // NOLINT(modernize-use-using): a C extension

/// Elementary symmetric sums of integers, exactly: |s_k| <= C(30, 15) 9^15 < 2^75.
std::vector<Wide> exactSums(const std::vector<int>& x) {
  std::vector<Wide> sums(x.size() + 1, 0);
  sums[0] = 1;
  for (std::size_t n = 0; n < x.size(); ++n) {
    for (std::size_t k = n + 1; k >= 1; --k) sums[k] += sums[k - 1] * x[n];
  }
  return sums;
}
Wide choose(std::size_t n, std::size_t k) {
  Wide c = 1;
  for (std::size_t i = 1; i <= k; ++i) c = c * static_cast<Wide>(n - k + i) / static_cast<Wide>(i);
  return c;
}
/// m_k exactly rounded to long double.
long double exactMean(const std::vector<int>& x, std::size_t k) {
  return static_cast<long double>(exactSums(x)[k]) / static_cast<long double>(choose(x.size(), k));
}

std::vector<int> randomIntegers(Rng& rng, std::size_t n, int low, int high) {
  std::vector<int> x(n);
  for (int& value : x)
    value = low + static_cast<int>(rng.uniformInt(static_cast<std::uint32_t>(high - low + 1)));
  return x;
}

std::vector<double> meansOf(const std::vector<int>& x) {
  std::vector<double> means(x.size() + 1);
  const std::vector<double> values(x.begin(), x.end());
  const double scale = elementarySymmetricMeans(values, means);
  for (std::size_t k = 1; k < means.size(); ++k) means[k] *= std::pow(scale, static_cast<double>(k));
  return means;
}

/// The way through sums of powers, k e_k = sum_i (-1)^(i-1) e_{k-i} p_i.
std::vector<double> girardNewton(const std::vector<int>& x) {
  std::vector<double> e(x.size() + 1), powers(x.size() + 1);
  e[0] = 1;
  for (std::size_t k = 1; k <= x.size(); ++k) {
    for (const int value : x) powers[k] += std::pow(value, static_cast<double>(k));
    for (std::size_t i = 1; i <= k; ++i) e[k] += (i % 2 ? 1 : -1) * e[k - i] * powers[i];
    e[k] /= static_cast<double>(k);
  }
  return e;
}

TEST(SymmetricMeans, AgreeWithExactIntegersOfOneSignToTheLastDigits) {
  Rng rng(1);
  for (std::size_t n = 1; n <= 30; ++n) {
    for (const auto& [low, high] : {std::pair{0, 9}, {1, 9}, {-9, 0}}) {
      const std::vector<int> x = randomIntegers(rng, n, low, high);
      const std::vector<double> means = meansOf(x);
      for (std::size_t k = 0; k <= n; ++k) {
        const auto exact = static_cast<double>(exactMean(x, k));
        EXPECT_NEAR(means[k], exact, std::abs(exact) * 1e-14) << "N " << n << ", k " << k;
      }
    }
  }
}

TEST(SymmetricMeans, AgreeWithExactIntegersOfBothSignsRelativeToTheSizeOfTheProducts) {
  Rng rng(2);
  for (std::size_t n = 1; n <= 30; ++n) {
    const std::vector<int> x = randomIntegers(rng, n, -9, 9);
    std::vector<int> sizes;
    for (const int value : x) sizes.push_back(std::abs(value));
    const std::vector<double> means = meansOf(x);
    for (std::size_t k = 0; k <= n; ++k) {
      EXPECT_NEAR(means[k], static_cast<double>(exactMean(x, k)),
                  static_cast<double>(exactMean(sizes, k)) * 1e-14)
          << "N " << n << ", k " << k;
    }
  }
}

/// Negative control: the tolerance above tells this method from sums of powers, which lose all digits.
TEST(SymmetricMeans, KeepDigitsThatSumsOfPowersLose) {
  Rng rng(3);
  const std::vector<int> x = randomIntegers(rng, 30, 1, 9);
  const std::vector<double> sums = girardNewton(x);
  double worst = 0;
  for (std::size_t k = 1; k <= 30; ++k) {
    const auto exact = static_cast<double>(exactSums(x)[k]);
    worst = std::max(worst, std::abs(sums[k] - exact) / exact);
  }
  EXPECT_GT(worst, 1e-3);
}

TEST(SymmetricMeans, OfEqualValuesAreTheirPowers) {
  std::vector<double> means(41);
  EXPECT_EQ(elementarySymmetricMeans(std::vector<double>(40, .25), means), .25);
  for (const double m : means) EXPECT_EQ(m, 1.0);
  elementarySymmetricMeans(std::vector<double>(40, 0.), means);
  for (std::size_t k = 1; k <= 40; ++k) EXPECT_EQ(means[k], 0.0);
  EXPECT_EQ(means[0], 1.0);
}

TEST(SymmetricMeans, NeitherOverflowNorExceedOne) {
  Rng rng(4);
  std::vector<double> x(3000), means(3001);
  for (const double size : {1e-300, 1., 1e300}) {
    for (double& value : x) value = size * rng.uniformDouble();
    const double scale = elementarySymmetricMeans(x, means);
    EXPECT_NEAR(scale, size / 2, size / 20);
    for (const double m : means) {
      ASSERT_GE(m, 0.0);
      ASSERT_LE(m, 1 + 1e-12);
    }
  }
}

TEST(SymmetricMeans, StopAtTheOrderThatIsAskedFor) {
  const std::vector<double> x{1, 2, 3, 4, 5};
  std::vector<double> all(6), some(3);
  elementarySymmetricMeans(x, all);
  elementarySymmetricMeans(x, some);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(some[k], all[k]);
}

/// By hand, after the published loop: N = 3 and scale 2, so x / scale = 1, 2, 0 and m_1 gets (1/3) (2 - 0),
/// then (1/3) (0 - m_1); m_2 gets (2/3) (m_1 0 - 0); m_3 nothing.
TEST(PublishedSymmetricMeans, LeaveOutFactorsAndDivideByAllOfThem) {
  const std::vector<double> x{2, 4, 0};
  std::vector<double> means(4);
  EXPECT_DOUBLE_EQ(publishedSymmetricMeans(x, means), 2);
  EXPECT_EQ(means[0], 1);
  EXPECT_DOUBLE_EQ(means[1], 2. / 3 - 2. / 9);
  EXPECT_EQ(means[2], 0);
  EXPECT_EQ(means[3], 0);
}

TEST(LeadingProducts, AreThoseOfTheFirst) {
  const std::vector<double> x{3, -1, 2};
  std::vector<double> products(4);
  const double scale = leadingProducts(x, products);
  EXPECT_DOUBLE_EQ(scale, 2);
  EXPECT_DOUBLE_EQ(products[1] * scale, 3);
  EXPECT_DOUBLE_EQ(products[2] * scale * scale, -3);
  EXPECT_DOUBLE_EQ(products[3] * scale * scale * scale, -6);
}

}  // namespace
}  // namespace pbrtmedia
