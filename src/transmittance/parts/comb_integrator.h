// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/comb.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Independent estimates of the integral of the density over one line, each from one comb of `teeth`
/// look-ups.
///
/// In the comb's variable z in [0, 1] the integrand is h(z) = rho(s) / pdf(s), where z = integral of pdf up
/// to s: pdf = 1 / length, or proportional to the super-voxel means if warped. Integral: mean of h over the
/// teeth, plus (1/2 - mean of z) (h(1) - h(0)) if the end points are matched, which makes a linear h exact
/// and is Kettunen et al. 2021 (35) for the equidistant comb; the general form serves every comb. Unbiased
/// for every density, whatever stands for h(0) and h(1); constants are exact, as is any linear h with matched
/// ends. Such a one is nowhere above twice its integral, so ends are cut to twice that of the bounds: the
/// density of a thin shell at an end, or over a super-voxel mean far below it, says nothing of the rest, and
/// would move single estimates by many times the optical depth. Not warped where a mean is unknown, nor where
/// an unproven bound of 0 would keep points away from density.
///
/// Look-ups: `teeth` per comb, less those that fall into super-voxels proven empty; two for the end points,
/// made when the first comb is. In batches; memory of one batch, on the stack, for any number of teeth.
/// Borrows its arguments. With `checksBounds` every look-up is compared with its bound.
template <DensityLine Line>
class CombIntegrator {
 public:
  CombIntegrator(const Line& line, const BoundProfile& profile, const CombSettings& settings,
                 std::uint64_t teeth, bool checksBounds, SampleStream& stream, LookupTally& tally)
      : line_(line),
        profile_(profile),
        comb_(settings.comb),
        teeth_(teeth),
        matches_(settings.matches(teeth)),
        warps_(shouldWarp(line, profile, settings.warp, teeth)),
        skipsEmpty_(line.hasProvenBounds() && !warps_ && hasEmpty(profile)),
        checks_(checksBounds),
        piece_(profile.pieces().data()),
        stream_(stream),
        tally_(tally) {}

  /// One more estimate of the integral (unit of s).
  double integral() {
    const bool oneOffset = comb_ == Comb::Equidistant || comb_ == Comb::GoldenRatio;
    return integralFrom(oneOffset ? stream_.uniform() : 0);
  }
  /// The estimate of the comb with this offset, in [0, 1); unused by combs without one.
  double integralFrom(double offset) {
    if (matches_ && !hasEnds_) {
      ends_ = lookUpEnds();
      hasEnds_ = true;
    }
    double sum = 0, sumZ = 0;
    std::array<double, kBatch> z;
    for (std::uint64_t first = 0; first < teeth_; first += kBatch) {
      const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, teeth_ - first));
      placeTeeth(first, offset, std::span(z).first(n));
      if (matches_ && comb_ != Comb::Equidistant) {
        for (std::size_t i = 0; i < n; ++i) sumZ += z[i];
      }
      sum += warps_ ? sumWarped(std::span(z).first(n)) : sumStraight(std::span(z).first(n));
    }
    const double m = static_cast<double>(teeth_);
    double mean = (warps_ ? profile_.mean() : profile_.length()) * sum / m;
    if (matches_) {
      // The mean of z of an equidistant comb: (u + (M - 1) / 2) / M.
      const double beyondMiddle = comb_ == Comb::Equidistant ? (0.5 - offset) / m : 0.5 - sumZ / m;
      mean += beyondMiddle * (ends_.last - ends_.first);
    }
    return mean;
  }
  /// Twice the teeth from now on, spread as before; end points stay matched if they were. The combs at the
  /// offsets u and u + 1/2 before are together the one at 2 u modulo 1.
  void doubleTeeth() { teeth_ *= 2; }
  bool isWarped() const { return warps_; }

 private:
  static constexpr std::size_t kBatch = 256;
  /// With fewer intervals per tooth the straight comb already resolves what the means tell, and the jumps
  /// that the warp puts into h at every border cost more than the better spread gains: on grids of noise
  /// warping gains a factor 2 to 5 in variance x cost below a quarter tooth per interval, and loses it above
  /// one.
  static constexpr std::uint64_t kLeastIntervalsPerWarpedTooth = 2;

  using Density = DensityOf<Line>;
  struct Ends {
    double first, last;  ///< h(0), h(1)
  };

  static bool hasEmpty(const BoundProfile& profile) {
    return std::any_of(profile.pieces().begin(), profile.pieces().end(),
                       [](const BoundPiece& piece) { return !(piece.upper > 0); });
  }
  static bool shouldWarp(const Line& line, const BoundProfile& profile, Warp warp, std::uint64_t teeth) {
    const std::uint64_t intervals = profile.pieces().size();
    if (warp == Warp::Off || intervals < 2 || !profile.hasMeans() || !(profile.mean() > 0)) return false;
    if (warp == Warp::Auto && teeth > intervals / kLeastIntervalsPerWarpedTooth) return false;
    return line.hasProvenBounds() || !hasEmpty(profile);
  }

  void placeTeeth(std::uint64_t first, double offset, std::span<double> z) {
    const double j = static_cast<double>(first), inverse = 1 / static_cast<double>(teeth_);
    switch (comb_) {
      case Comb::Equidistant:
        for (std::size_t i = 0; i < z.size(); ++i) z[i] = (offset + (j + static_cast<double>(i))) * inverse;
        break;
      case Comb::Stratified:
        for (std::size_t i = 0; i < z.size(); ++i) {
          z[i] = (stream_.uniform() + (j + static_cast<double>(i))) * inverse;
        }
        break;
      case Comb::Independent:
        for (double& value : z) value = stream_.uniform();
        break;
      case Comb::GoldenRatio:
        for (std::size_t i = 0; i < z.size(); ++i) {
          constexpr double kGolden = 0.61803398874989484820;
          const double turns = offset + (j + static_cast<double>(i)) * kGolden;
          z[i] = turns - std::floor(turns);
        }
        break;
    }
  }

  /// Sum of rho at the teeth.
  double sumStraight(std::span<const double> z) {
    std::array<double, kBatch> s;
    std::size_t n = 0;
    for (const double value : z) {
      s[n] = value * profile_.length();
      if (!skipsEmpty_ || pieceAt(s[n]).upper > 0) ++n;
    }
    std::array<Density, kBatch> density;
    lookUp(std::span(s).first(n), std::span(density).first(n));
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(density[i]);
    return sum;
  }
  /// Sum of rho / (mean of its super-voxel) at the teeth.
  double sumWarped(std::span<const double> z) {
    std::array<double, kBatch> s, mean;
    for (std::size_t i = 0; i < z.size(); ++i) {
      const BoundProfile::Place place = profile_.place(BoundProfile::Weight::Mean, z[i] * profile_.mean());
      s[i] = place.s;
      mean[i] = place.piece->mean;
    }
    std::array<Density, kBatch> density;
    lookUp(std::span(s).first(z.size()), std::span(density).first(z.size()));
    double sum = 0;
    for (std::size_t i = 0; i < z.size(); ++i) sum += static_cast<double>(density[i]) / mean[i];
    return sum;
  }
  Ends lookUpEnds() {
    std::array<double, 2> s{0, profile_.length()}, scale{profile_.length(), profile_.length()};
    if (warps_) {
      const auto first = profile_.place(BoundProfile::Weight::Mean, 0);
      const auto last = profile_.place(BoundProfile::Weight::Mean, profile_.mean());
      s = {first.s, last.s};
      scale = {profile_.mean() / first.piece->mean, profile_.mean() / last.piece->mean};
    }
    std::array<Density, 2> density;
    lookUp(s, density);
    const double most = 2 * profile_.upper();
    return {std::min(static_cast<double>(density[0]) * scale[0], most),
            std::min(static_cast<double>(density[1]) * scale[1], most)};
  }

  void lookUp(std::span<const double> s, std::span<Density> density) {
    if (s.empty()) return;
    line_.densities(s, density);
    tally_.lookups += s.size();
    if (!checks_) return;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double bound = pieceAt(s[i]).upper;
      if (static_cast<double>(density[i]) > bound) {
        tally_.noteViolation(s[i], static_cast<double>(density[i]), bound);
      }
    }
  }

  /// The interval that holds s: mostly that of the point before, or the next.
  const BoundPiece& pieceAt(double s) {
    const std::span<const BoundPiece> pieces = profile_.pieces();
    const BoundPiece* const last = &pieces.back();
    const auto holds = [&](const BoundPiece* p) { return s >= p->sEnter && (s < p->sExit || p == last); };
    if (holds(piece_)) return *piece_;
    if (piece_ != last && holds(piece_ + 1)) return *++piece_;
    const auto after = std::upper_bound(pieces.begin(), pieces.end(), s,
                                        [](double value, const BoundPiece& p) { return value < p.sEnter; });
    piece_ = after == pieces.begin() ? &pieces.front() : &*(after - 1);
    return *piece_;
  }

  const Line& line_;
  const BoundProfile& profile_;
  Comb comb_;
  std::uint64_t teeth_;
  bool matches_, warps_, skipsEmpty_, checks_;
  const BoundPiece* piece_;
  Ends ends_{0, 0};
  bool hasEnds_ = false;
  SampleStream& stream_;
  LookupTally& tally_;
};

}  // namespace pbrtmedia
