// SPDX-License-Identifier: BSD-2-Clause
#include "media/tracking_choice.h"

#include "freeflight/flight_list.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

// Of random grids of 4, 8, 16, 24 and 48 voxels an edge (7, 13, 25, 37 and 76 pieces a line) regular tracking
// won in the first three.
constexpr double kFewPieces = 25;
// At lower bounds of 0.67 of the upper ones residual ratio tracking won, at 0.26 no longer.
constexpr double kCloseBounds = 0.5;
// Below this weight walks of ratio and residual ratio tracking may end.
constexpr double kLittleWeight = 0.3;
// Debiased ray marching won at optical depths of 2 to 5.6, drew at 6.7 and lost at 20; with mean densities of
// 0.18 of the bounds it won, at 0.01 it lost badly.
constexpr double kThinColumn = 6;
constexpr double kEven = 0.1;

}  // namespace

AnyEstimator chooseEstimator(const TrackingFacts& facts) {
  const LineStatistics& lines = facts.lines;
  if (facts.provenBounds) {
    // In 24 scenes of absorbing noise and clouds it took .004 to 1.05 times the variance x seconds of what
    // was chosen without regard to that: on average .3 where the sky is seen through them, .94 in shadows.
    if (facts.onlyAbsorbs && lines.pieces > kFewPieces) return TelescopingRayMarching{};
    if (lines.lowerShare >= kCloseBounds) return ResidualRatioTracking{.rouletteThreshold = kLittleWeight};
    if (lines.pieces <= kFewPieces) return RegularTracking{};
    const bool isThin = lines.column * facts.sigmaT <= kThinColumn;
    if (facts.batchedLookups && isThin && lines.meanShare >= kEven) return DebiasedRayMarching{};
  }
  return ratioTrackingWithRoulette();
}

AnyEstimator ratioTrackingWithRoulette() { return RatioTracking{.rouletteThreshold = kLittleWeight}; }

AnyEstimator estimatorOfAnyLaw(bool hasPieces) {
  return hasPieces ? AnyEstimator(RegularTracking{}) : AnyEstimator(DebiasedRayMarching{});
}

AnyFlight flightOfAnyLaw(bool hasPieces) {
  return hasPieces ? AnyFlight(RegularFlight{}) : AnyFlight(DebiasedFlight{});
}

}  // namespace pbrtmedia
