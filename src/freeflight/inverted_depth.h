// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/rng.h"
#include "freeflight/flight_sample.h"

namespace pbrtmedia {

/// What samplers share that know the integral of the density: the flight ends where the optical depth of one
/// channel, chosen at random, reaches an exponential variate, and weighs by the mean density of all channels
/// (spectral multiple importance sampling; grey media weigh 1).
template <std::size_t N>
class InvertedDepth {
 public:
  /// sigmaT: some channel > 0.
  InvertedDepth(const Channels<N>& sigmaT, Rng& rng) : sigmaT_(sigmaT) {
    const std::size_t channel = N == 1 ? 0 : rng.uniformInt(static_cast<std::uint32_t>(N));
    const double depth = rng.exponential();
    column_ = sigmaT[channel] > 0 ? depth / sigmaT[channel] : std::numeric_limits<double>::infinity();
  }

  /// The integral of the density at which the flight ends.
  double column() const { return column_; }
  /// Weights of a collision behind this integral: sigma_t T over the mean of all channels' sigma_t T.
  Channels<N> collidedAt(double column) const { return weights(column, true); }
  /// Weights of having passed: T over the mean of all channels' T.
  Channels<N> passedAt(double column) const { return weights(column, false); }

 private:
  Channels<N> weights(double column, bool collided) const {
    // Relative to the clearest channel, which keeps the sum from vanishing.
    double clearest = std::numeric_limits<double>::infinity();
    for (const double sigma : sigmaT_) {
      if (!collided || sigma > 0) clearest = std::min(clearest, sigma);
    }
    Channels<N> weight;
    double sum = 0;
    for (std::size_t c = 0; c < N; ++c) {
      weight[c] = std::exp(-(sigmaT_[c] - clearest) * column) * (collided ? sigmaT_[c] : 1);
      if (collided && !(sigmaT_[c] > 0)) weight[c] = 0;
      sum += weight[c];
    }
    for (double& w : weight) w *= static_cast<double>(N) / sum;
    return weight;
  }

  Channels<N> sigmaT_;
  double column_;
};

}  // namespace pbrtmedia
