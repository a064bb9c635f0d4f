// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/symmetric_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pbrtmedia {
namespace {

/// Begins powers with power 0 alone; answers the scale, 0 where no other is needed.
double beginPowers(std::span<const double> x, std::span<double> powers) {
  std::fill(powers.begin(), powers.end(), 0.0);
  if (powers.empty()) return 0;
  powers[0] = 1;
  double scale = 0;
  for (const double value : x) scale += std::abs(value);
  scale /= static_cast<double>(x.size());
  return scale > 0 ? scale : 0;
}

}  // namespace

double elementarySymmetricMeans(std::span<const double> x, std::span<double> means) {
  const double scale = beginPowers(x, means);
  if (!(scale > 0)) return 0;
  for (std::size_t n = 1; n <= x.size(); ++n) {
    const double value = x[n - 1] / scale, inverse = 1 / static_cast<double>(n);
    for (std::size_t k = std::min(n, means.size() - 1); k >= 1; --k) {
      means[k] += static_cast<double>(k) * inverse * (means[k - 1] * value - means[k]);
    }
  }
  return scale;
}

double publishedSymmetricMeans(std::span<const double> x, std::span<double> means) {
  const double scale = beginPowers(x, means), inverse = 1 / static_cast<double>(x.size());
  if (!(scale > 0)) return 0;
  for (std::size_t n = 2; n <= x.size(); ++n) {
    const double value = x[n - 1] / scale;
    for (std::size_t k = std::min(n - 1, means.size() - 1); k >= 1; --k) {
      means[k] += static_cast<double>(k) * inverse * (means[k - 1] * value - means[k]);
    }
  }
  return scale;
}

double leadingProducts(std::span<const double> x, std::span<double> products) {
  const double scale = beginPowers(x, products);
  if (!(scale > 0)) return 0;
  for (std::size_t k = 1; k < products.size(); ++k) products[k] = products[k - 1] * (x[k - 1] / scale);
  return scale;
}

}  // namespace pbrtmedia
