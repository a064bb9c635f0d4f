// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/parameters.h"

namespace pbrtmedia {

/// Where the teeth z_0 .. z_{M-1} of a comb lie in [0, 1). Each pattern estimates an integral without bias.
enum class Comb {
  Equidistant,  ///< (u + j) / M with one offset u
  Stratified,   ///< (u_j + j) / M
  Independent,  ///< u_j
  GoldenRatio   ///< u + j (sqrt(5) - 1) / 2, modulo 1
};
template <>
inline constexpr std::array kChoices<Comb>{std::string_view("equidistant"), std::string_view("stratified"),
                                           std::string_view("independent"), std::string_view("goldenratio")};

/// Whether the straight line through the integrand's end points is integrated exactly, for two look-ups that
/// all combs of an estimate share.
enum class EndpointMatching {
  Off,
  Auto,  ///< for combs of kLeastMatchedTeeth teeth or more
  On
};
template <>
inline constexpr std::array kChoices<EndpointMatching>{std::string_view("off"), std::string_view("auto"),
                                                       std::string_view("on")};

/// Whether teeth are spread in proportion to the means of the super-voxels.
enum class Warp {
  Auto,  ///< where means are known and a comb has at most one tooth for two intervals
  Off,
  On  ///< wherever means are known
};
template <>
inline constexpr std::array kChoices<Warp>{std::string_view("auto"), std::string_view("off"),
                                           std::string_view("on")};

/// How an estimator combs a line.
struct CombSettings {
  /// Below this the two look-ups pay less than two teeth more. Kettunen et al. 2021, section 4.4.
  static constexpr std::uint64_t kLeastMatchedTeeth = 8;

  static constexpr std::string_view kCombHelp =
      "where the look-ups of one comb lie: one offset, jittered, independent, or the golden-ratio sequence";
  static constexpr std::string_view kMatchingHelp =
      "integrate the straight line through the end points exactly, for two look-ups; auto: from 8 teeth on";
  static constexpr std::string_view kWarpHelp =
      "spread look-ups in proportion to the super-voxel means where these are known; auto: only with at most "
      "one look-up for two super-voxels";

  Comb comb = Comb::Equidistant;
  EndpointMatching matching = EndpointMatching::Auto;
  Warp warp = Warp::Auto;

  bool matches(std::uint64_t teeth) const {
    return matching == EndpointMatching::On ||
           (matching == EndpointMatching::Auto && teeth >= kLeastMatchedTeeth);
  }
};

}  // namespace pbrtmedia
