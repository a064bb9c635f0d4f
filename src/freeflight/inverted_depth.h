// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// What samplers share that know the integral of the density: the flight ends where the optical depth of one
/// channel, chosen at random, reaches an exponential variate (under another law g one that exceeds F with
/// probability g(F)), and weighs by the mean density of all channels (spectral multiple importance sampling;
/// grey media weigh 1).
template <std::size_t N>
class InvertedDepth {
 public:
  /// sigmaT: some channel > 0. A channel is chosen in proportion to its importance.
  InvertedDepth(const FlightQuery<N>& query, SampleStream& stream)
      : sigmaT_(query.sigmaT), importance_(query.importance), law_(query.law) {
    const std::size_t channel = N == 1 ? 0 : chooseChannel(importance_, stream.uniform());
    const double depth = law_ ? depthReachedOf(*law_, 1 - stream.uniform()) : stream.exponential();
    column_ = sigmaT_[channel] > 0 ? depth / sigmaT_[channel] : std::numeric_limits<double>::infinity();
  }

  /// The integral of the density at which the flight ends.
  double column() const { return column_; }
  /// Weights of a collision behind this integral, times the importance: sigma_t T over the mean of all
  /// channels' importance times sigma_t T.
  Channels<N> collidedAt(double column) const { return weights(column, true); }
  /// The same of having passed, with T instead of sigma_t T.
  Channels<N> passedAt(double column) const { return weights(column, false); }

 private:
  Channels<N> weights(double column, bool collided) const {
    if constexpr (N == 1) return filled<1>(1);
    if (law_) return weightsUnderLaw(column, collided);
    // Relative to the clearest channel that counts, which keeps the sum from vanishing.
    double clearest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < N; ++c) {
      if (importance_[c] > 0 && (!collided || sigmaT_[c] > 0)) clearest = std::min(clearest, sigmaT_[c]);
    }
    Channels<N> weight;
    double sum = 0;
    for (std::size_t c = 0; c < N; ++c) {
      const double factor = importance_[c] * (collided ? sigmaT_[c] : 1);
      // An endless way lets the clearest channel through all the same.
      const double excess = sigmaT_[c] - clearest;
      weight[c] = factor > 0 ? factor * (excess > 0 ? std::exp(-excess * column) : 1) : 0;
      sum += weight[c];
    }
    for (double& w : weight) w *= static_cast<double>(N) / sum;
    return weight;
  }

  Channels<N> weightsUnderLaw(double column, bool collided) const {
    Channels<N> weight;
    double sum = 0;
    for (std::size_t c = 0; c < N; ++c) {
      const double depth = sigmaT_[c] > 0 ? sigmaT_[c] * column : 0;
      weight[c] = importance_[c] *
                  (collided ? sigmaT_[c] * collisionDensityOf(*law_, depth) : transmittanceOf(*law_, depth));
      sum += weight[c];
    }
    for (double& w : weight) w *= sum > 0 ? static_cast<double>(N) / sum : 0;
    return weight;
  }

  Channels<N> sigmaT_, importance_;
  const AnyLaw* law_;  ///< null: exponential
  double column_;
};

}  // namespace pbrtmedia
