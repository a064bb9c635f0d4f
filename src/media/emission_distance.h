// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <optional>

#include "base/rng.h"

namespace pbrtmedia {

/// Distances along a segment with density proportional to what a stand-in for the medium, constant on each of
/// consecutive intervals, would emit and let through to the segment's start:
///
///   p(s) = (1 - share) sum_c e_c(s) exp(-depth_c(s)) / total  +  share sum_c e_c(s) / totalEmitted
///
/// over three channels c. Where the stand-in is the medium itself (homogeneous) the estimate T e / p of the
/// emitted radiance varies with colour only; the second term, for stand-ins that may be wrong about the
/// depth, keeps that quotient within 1/share of what is emitted. Every distance where e > 0 has p > 0.
///
/// Intervals are added in order of s, the first beginning at 0; the last may be endless. Several classes
/// share the arithmetic: EmissionSampler draws, EmissionDensity tells the density.
class EmissionProfile {
 public:
  using Channels = std::array<double, 3>;
  /// The share of the second term for media with a field.
  static constexpr double kDefensiveShare = 0.1;

 protected:
  explicit EmissionProfile(double share) : share_(share) {}

  struct Step {
    Channels weight;       ///< of this interval, in `total`
    Channels depthBefore;  ///< from the start to where it begins
    double attenuated;     ///< sum of the weights
    double emitted;        ///< of this interval, in `totalEmitted`
  };
  /// Adds an interval to the totals.
  Step advance(double sEnter, double sExit, const Channels& emission, const Channels& sigmaT);
  /// p(s) `offset` behind the start of an interval.
  double densityIn(const Channels& emission, const Channels& sigmaT, const Channels& depthBefore,
                   double offset) const;

 private:
  double share_, total_ = 0, totalEmitted_ = 0;
  Channels depth_{};

 protected:
  double total() const { return total_; }
  double totalEmitted() const { return totalEmitted_; }
  double share() const { return share_; }
};

/// Draws one distance. Each interval may replace the one chosen so far, so one walk is enough.
class EmissionSampler : private EmissionProfile {
 public:
  using EmissionProfile::Channels;
  using EmissionProfile::kDefensiveShare;
  EmissionSampler(double share, Rng& rng)
      : EmissionProfile(share), rng_(rng), defensive_(share > 0 && rng.uniformDouble() < share) {}
  void add(double sEnter, double sExit, const Channels& emission, const Channels& sigmaT);
  struct Distance {
    double s, pdf;
  };
  /// After the last interval. Nothing when nothing emits.
  std::optional<Distance> distance();

 private:
  Rng& rng_;
  bool defensive_;
  bool hasChosen_ = false;
  double sEnter_ = 0, sExit_ = 0;
  Channels emission_{}, sigmaT_{}, depthBefore_{}, weight_{};
};

/// The density of EmissionSampler's distances at one s.
class EmissionDensity : private EmissionProfile {
 public:
  using EmissionProfile::Channels;
  using EmissionProfile::kDefensiveShare;
  EmissionDensity(double share, double s) : EmissionProfile(share), s_(s) {}
  void add(double sEnter, double sExit, const Channels& emission, const Channels& sigmaT);
  /// After the last interval. 0 outside all of them.
  double pdf() const;

 private:
  double s_, offset_ = -1;
  Channels emission_{}, sigmaT_{}, depthBefore_{};
};

}  // namespace pbrtmedia
