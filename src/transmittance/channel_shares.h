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

}  // namespace pbrtmedia
