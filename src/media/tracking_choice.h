// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "freeflight/any_flight.h"
#include "media/line_statistics.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// What is known of a medium for which nobody named an estimator.
struct TrackingFacts {
  LineStatistics lines;
  double sigmaT = 0;            ///< of the densest channel at density 1, 1/world length
  bool provenBounds = false;    ///< bounds and means are those of the data
  bool batchedLookups = false;  ///< many points of a line cost less than as many single ones
  bool onlyAbsorbs = false;     ///< transmittance is all the noise there is
};

/// The estimator of the least variance times time, by measurements of whole renders (docs/scene-language.md):
///   - nothing is scattered, and lines cross many cubic pieces: telescoping ray marching, the least noise;
///   - lines cross few cubic pieces: regular tracking, exact for few look-ups;
///   - bounds close in on the density: residual ratio tracking, few look-ups and little variance;
///   - thin, even and quick to look up: debiased ray marching, nearly exact for a batch of look-ups;
///   - otherwise ratio tracking with a roulette, whose look-ups end where light does.
/// Unbiased, whatever the facts.
AnyEstimator chooseEstimator(const TrackingFacts& facts);
/// The last of these: what the parameters of a scene that names no estimator are parameters of.
AnyEstimator ratioTrackingWithRoulette();

/// For laws beside the exponential one, by whether the density has cubic pieces: exact where it has.
AnyEstimator estimatorOfAnyLaw(bool hasPieces);
/// Unbiased flights for laws that the default ones do not serve.
AnyFlight flightOfAnyLaw(bool hasPieces);

}  // namespace pbrtmedia
