// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// The upper control of one line in its own optical depth: the local bounds times the extinction of the
/// largest channel. Points on it are given by the control's optical depth from the start, so a Poisson
/// process of rate 1 there is one of rate `majorant` on the line, and cutting an interval of constant bound
/// in two changes nothing. Stretches whose bound is 0 have no points; unproven ones are probed once, in the
/// constructor. Lives on the stack of one estimate; borrows line and tally.
template <DensityLine Line, std::size_t N>
class UpperControl {
 public:
  /// sigmaT: >= 0, finite. All 0: a depth of 0.
  UpperControl(const Line& line, const Channels<N>& sigmaT, SampleStream& stream, LookupTally& tally)
      : line_(line), profile_(line), sigmaMax_(maxOf(sigmaT)), tally_(tally) {
    if (!(sigmaMax_ > 0)) return;
    share_ = sharesOf(sigmaT, sigmaMax_);
    depth_ = sigmaMax_ * profile_.upper();
    for (const BoundPiece& piece : profile_.pieces()) {
      if (!(piece.upper > 0)) probeTrusted(line_, piece.sEnter, piece.sExit, 0, stream.rng(), tally_);
    }
  }

  /// Optical depth of the whole control in the largest channel, >= 0.
  double depth() const { return depth_; }

  /// Looks up the density at `depth`, in [0, depth()], depth() > 0. Answers null extinction / control per
  /// channel: 1 - sigmaT[c] rho / majorant; below 0 where the bound of the largest channel is violated.
  Channels<N> nullRatio(double depth) {
    const BoundProfile::Place place = profile_.place(BoundProfile::Weight::Upper, depth / sigmaMax_);
    const double upper = place.piece->upper;
    return nullShares(share_, boundedLookup(line_, place.s, upper, tally_) / upper);
  }

 private:
  const Line& line_;
  BoundProfile profile_;
  double sigmaMax_, depth_ = 0;
  Channels<N> share_{};
  LookupTally& tally_;
};

}  // namespace pbrtmedia
