// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "transmittance/estimate.h"
#include "transmittance/law.h"

namespace pbrtmedia {

/// What a free flight is asked for.
template <std::size_t N>
struct FlightQuery {
  Channels<N> sigmaT;                     ///< extinction at density 1, 1/world length, >= 0
  Channels<N> albedo = filled<N>(1);      ///< in [0, 1]
  Channels<N> importance = filled<N>(1);  ///< what each channel counts (importanceOf), mean 1
  const AnyLaw* law = nullptr;            ///< FlightTraits::laws; null: the exponential one
};

/// How much the channels of a path count when chances are shared out among them: the magnitudes of its
/// throughput, scaled to mean 1. With it, chances follow the whole path and not this flight alone, so the
/// path's weights are those of the balance heuristic over the channels and never exceed N. Channels of
/// nothing, or of something infinite, count alike.
template <std::size_t N>
Channels<N> importanceOf(const Channels<N>& throughput) {
  if constexpr (N == 1) return filled<1>(1);
  double sum = 0;
  for (const double t : throughput) sum += std::abs(t);
  if (!(sum > 0) || !std::isfinite(sum)) return filled<N>(1);
  Channels<N> importance;
  for (std::size_t c = 0; c < N; ++c)
    importance[c] = std::abs(throughput[c]) * (static_cast<double>(N) / sum);
  return importance;
}

/// The channel that a number of [0, 1) chooses, each in proportion to its importance; one of nothing never.
template <std::size_t N>
std::size_t chooseChannel(const Channels<N>& importance, double u) {
  u *= static_cast<double>(N);
  std::size_t chosen = 0;
  for (std::size_t c = 0; c < N; ++c) {
    if (!(importance[c] > 0)) continue;
    chosen = c;
    if (u < importance[c]) break;
    u -= importance[c];
  }
  return chosen;
}

/// The weights of the flight itself. A channel that counts nothing was not asked for: its weight is 0.
template <std::size_t N>
Channels<N> withoutImportance(const FlightQuery<N>& query, Channels<N> weight) {
  if constexpr (N > 1) {
    for (std::size_t c = 0; c < N; ++c)
      weight[c] = query.importance[c] > 0 ? weight[c] / query.importance[c] : 0;
  }
  return weight;
}

}  // namespace pbrtmedia
