// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <optional>

#include "base/rng.h"
#include "transmittance/law.h"

namespace pbrtmedia {

/// Draws a distance along a segment with density proportional to what a stand-in for the medium, constant on
/// each of consecutive intervals, would emit and let through to the segment's start:
///
///   p(s) = (1 - share) sum_c e_c(s) exp(-depth_c(s)) / total  +  share sum_c e_c(s) / totalEmitted
///
/// over three channels c; under another law g of the medium, -g'(depth_c) stands for exp(-depth_c). Where the
/// stand-in is the medium itself (homogeneous) the estimate T e / p of the emitted radiance varies with
/// colour only; the second term, for stand-ins that may be wrong about the depth, keeps that quotient within
/// 1/share of what is emitted. Every distance where e > 0 has p > 0.
///
/// Intervals are added in order of s, the first beginning at 0; the last may be endless. Each may replace the
/// one chosen so far, so one walk is enough.
class EmissionSampler {
 public:
  using Channels = std::array<double, 3>;
  /// The share of the second term for media with a field.
  static constexpr double kDefensiveShare = 0.1;

  /// `law`: borrowed; null: the exponential one.
  EmissionSampler(double share, Rng& rng, const AnyLaw* law = nullptr)
      : rng_(rng), share_(share), defensive_(share > 0 && rng.uniformDouble() < share), law_(law) {}
  /// `tag`: comes back with a distance of this interval.
  void add(double sEnter, double sExit, const Channels& emission, const Channels& sigmaT, double tag = 0);
  struct Distance {
    double s, pdf, tag;
  };
  /// After the last interval. Nothing when nothing emits.
  std::optional<Distance> distance();

 private:
  /// p(s) `offset` behind the start of the chosen interval.
  double densityAt(double offset) const;
  /// The integral of -g'(depth) over the next interval, and the depths behind it.
  Channels collidedUnderLaw(const Channels& sigmaT, double length);
  /// `offset` in the chosen interval with density proportional to -g'(depth) of a channel.
  double offsetUnderLaw(std::size_t channel, double length);

  Rng& rng_;
  double share_;
  bool defensive_;
  const AnyLaw* law_;
  double total_ = 0, totalEmitted_ = 0;
  Channels through_{1, 1, 1};  ///< transmittance from the start to the next interval
  Channels depth_{};           ///< the same as optical depth; under another law only
  // The interval chosen so far.
  bool hasChosen_ = false;
  double sEnter_ = 0, sExit_ = 0, tag_ = 0;
  Channels emission_{}, sigmaT_{}, throughBefore_{}, depthBefore_{}, weight_{};
};

}  // namespace pbrtmedia
