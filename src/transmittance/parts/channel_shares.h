// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "transmittance/estimate.h"

namespace pbrtmedia {

/// Each channel as a share of `whole`, which is not 0: of the largest, it says how much of the common point
/// process is its own.
template <std::size_t N>
constexpr Channels<N> sharesOf(const Channels<N>& channels, double whole) {
  Channels<N> shares{};
  for (std::size_t c = 0; c < N; ++c) shares[c] = channels[c] / whole;
  return shares;
}

/// What is null at a point whose extinction in the largest channel is `ratio` times that of the control.
template <std::size_t N>
constexpr Channels<N> nullShares(const Channels<N>& shares, double ratio) {
  Channels<N> null{};
  for (std::size_t c = 0; c < N; ++c) null[c] = 1 - shares[c] * ratio;
  return null;
}

}  // namespace pbrtmedia
