// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/math.h"
#include "transmittance/estimate.h"

namespace pbrtmedia {

/// Beyond this many look-ups series end whatever maxlookups says, and are counted: F is then 0, or too small
/// beside its control for anybody to wait for.
inline constexpr std::uint64_t kMostReciprocalLookups = std::uint64_t{1} << 30;
inline constexpr std::string_view kReciprocalCountHelp =
    "look-ups whose mean is one factor of a term, spread in proportion to the control";
inline constexpr std::string_view kReciprocalCombHelp =
    "where the look-ups of one factor lie, in the control's own depth: one offset, jittered, independent, or "
    "the "
    "golden-ratio sequence";

inline std::uint64_t mostReciprocalLookups(std::uint64_t chosen) {
  return chosen > 0 && chosen < kMostReciprocalLookups ? chosen : kMostReciprocalLookups;
}

/// 1 / (sigmaT[c] integral) from an estimate of 1 / integral of the density; infinite without extinction.
template <std::size_t N>
Channels<N> reciprocalPerChannel(const Channels<N>& sigmaT, double ofIntegral) {
  Channels<N> value;
  for (std::size_t c = 0; c < N; ++c) {
    value[c] = sigmaT[c] > 0 ? ofIntegral / sigmaT[c] : kInfinity;
  }
  return value;
}

}  // namespace pbrtmedia
