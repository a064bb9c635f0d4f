// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "transmittance/estimate.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// A limit on the look-ups of one estimate, off at 0. Estimators that choose their cost beforehand (combs)
/// stay within it and stay unbiased. Walks and series end there, and what lies beyond is taken as clear
/// (walk) or as 0 (terms of a series): a bias, counted in LookupTally::capped and reported by the render.
class LookupLimit {
 public:
  static constexpr std::string_view kWalkHelp =
      "most look-ups of one estimate, 0: no limit; a walk that reaches it ends there, biased, and is counted";
  static constexpr std::string_view kSeriesHelp =
      "most look-ups of one estimate, 0: no limit; a series that reaches it ends there, biased, and is "
      "counted";
  static constexpr std::string_view kCombHelp =
      "most look-ups of one comb, 0: no limit; wider spaced teeth, more variance, no bias";

  explicit LookupLimit(std::uint64_t most) : most_(most) {}

  /// Whether one more look-up is too many; notes that the estimate was cut short.
  bool reached(LookupTally& tally) const {
    if (most_ == 0 || tally.lookups < most_) [[likely]] {
      return false;
    }
    tally.capped = 1;
    return true;
  }

  static constexpr EstimatorTraits::Bias bias(std::uint64_t most) {
    return most > 0 ? EstimatorTraits::Bias::Consistent : EstimatorTraits::Bias::Unbiased;
  }
  static constexpr std::string_view biasNote(std::uint64_t most) {
    return most > 0 ? "estimates that reach maxlookups are cut short" : "";
  }

 private:
  std::uint64_t most_;
};

}  // namespace pbrtmedia
