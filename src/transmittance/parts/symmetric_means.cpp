// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/symmetric_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pbrtmedia {

double elementarySymmetricMeans(std::span<const double> x, std::span<double> means) {
  std::fill(means.begin(), means.end(), 0.0);
  if (means.empty()) return 0;
  means[0] = 1;
  double scale = 0;
  for (const double value : x) scale += std::abs(value);
  scale /= static_cast<double>(x.size());
  if (!(scale > 0)) return 0;
  for (std::size_t n = 1; n <= x.size(); ++n) {
    const double value = x[n - 1] / scale, inverse = 1 / static_cast<double>(n);
    for (std::size_t k = std::min(n, means.size() - 1); k >= 1; --k) {
      means[k] += static_cast<double>(k) * inverse * (means[k - 1] * value - means[k]);
    }
  }
  return scale;
}

}  // namespace pbrtmedia
