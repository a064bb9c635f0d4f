// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "transmittance/estimate.h"
#include "transmittance/parts/running_product.h"

namespace pbrtmedia {

/// One running product per channel.
template <std::size_t N>
class ChannelProducts {
 public:
  explicit ChannelProducts(double logScale = 0) { products_.fill(RunningProduct(logScale)); }

  void multiply(const Channels<N>& ratio, double common = 1) {
    for (std::size_t c = 0; c < N; ++c) products_[c].multiply(ratio[c] * common);
  }
  void multiply(double common) {
    for (RunningProduct& p : products_) p.multiply(common);
  }
  /// Largest |product|, without exp(logScale).
  double magnitude() const {
    double largest = 0;
    for (const RunningProduct& p : products_) largest = std::max(largest, p.magnitude());
    return largest;
  }
  /// Nothing can come of it any more.
  bool isZero() const {
    return std::all_of(products_.begin(), products_.end(),
                       [](const RunningProduct& p) { return p.isZero(); });
  }
  /// sum[c] += product[c] exp(logScale).
  void addTo(Channels<N>& sum) const {
    for (std::size_t c = 0; c < N; ++c) addTerm(sum[c], products_[c].value());
  }
  /// sum[c] += product[c] exp(logScale + x) factor.
  void addTo(Channels<N>& sum, double x, double factor = 1) const {
    for (std::size_t c = 0; c < N; ++c) addTerm(sum[c], products_[c].timesExp(x) * factor);
  }
  /// The products times exp(-sigmaT[c] column): 0 where a product is, however large the rest.
  Channels<N> attenuated(const Channels<N>& sigmaT, double column) const {
    Channels<N> value;
    for (std::size_t c = 0; c < N; ++c) {
      value[c] = products_[c].isZero() ? 0 : products_[c].timesExp(-sigmaT[c] * column);
    }
    return value;
  }
  const RunningProduct& operator[](std::size_t c) const { return products_[c]; }

 private:
  std::array<RunningProduct, N> products_;
};

}  // namespace pbrtmedia
