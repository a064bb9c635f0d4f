// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "base/pixel_stream.h"
#include "base/ray.h"
#include "base/statistics.h"
#include "media/medium.h"
#include "media/phase/phase_function.h"
#include "spectrum/rgb.h"
#include "world/medium_state.h"

namespace pbrtmedia {

/// Outcome of a free flight through all media of a stretch.
struct MediumFlight {
  bool collided = false;
  double t = 0;
  Rgb weight{1.0f};                      ///< as in FreeFlight
  const PhaseFunction* phase = nullptr;  ///< of the medium that collided
  std::size_t medium = 0;                ///< its number among the active ones
};

/// A stretch of a ray on which the media stay the same, tMin < t < tMax, and all that they do together on it.
/// Borrows state and ray; cheap to make.
class MediaStretch {
 public:
  /// `tMax` may be infinite.
  MediaStretch(const MediumState& state, const Ray& ray, double tMin, double tMax)
      : state_(&state), ray_(&ray), tMin_(tMin), tMax_(tMax) {}

  const MediumState& state() const { return *state_; }
  const Ray& ray() const { return *ray_; }
  double tMin() const { return tMin_; }
  double tMax() const { return tMax_; }
  /// Its part before `t`.
  MediaStretch upTo(double t) const { return {*state_, *ray_, tMin_, t}; }

  /// Unbiased estimate of the transmittance of all active media, their product. Stops as soon as it is black.
  Rgb transmittance(PixelStream random, RenderCounters& counters) const;
  /// The same with what the media know of its noise.
  PairedTransmittance pairedTransmittance(PixelStream random, RenderCounters& counters) const;
  /// The nearest of independent free flights through the active media, weighted by what the other media let
  /// through up to there.
  /// `throughput`: of the path so far (Medium::sampleFreeFlight).
  MediumFlight sampleFreeFlight(Rgb throughput, PixelStream random, RenderCounters& counters) const;
  /// The same for light on its way to where paths from a camera find it, by their laws: what is here a start
  /// is where they end. Light of a collision at the start (`source`: the active medium that collided, or
  /// emits) is dimmed by Medium::collisionShare, all other light by the transmittance, and of either the
  /// media scatter sigma_s. So photons bring to a point what paths from there find, which under laws other
  /// than the exponential is not what light that flew and collided as those paths do would bring. Under the
  /// exponential law they do the same, and so does this.
  MediumFlight sampleFlightOfLight(std::optional<std::size_t> source, Rgb throughput, PixelStream random,
                                   RenderCounters& counters) const;
  /// What the media scatter at `t` from `wi` toward `wo` per length: the sum of sigma_s times the phase
  /// function. `wi` away from the point, as `wo`.
  Rgb scattering(double t, Vector3f wo, Vector3f wi, RenderCounters& counters) const;
  /// What the media together scatter and take away at `t`, 1/length.
  struct Coefficients {
    Rgb sigmaS, sigmaT;
  };
  Coefficients coefficients(double t, RenderCounters& counters) const;
  /// The scattering coefficient of the media together at `t`, 1/length.
  Rgb sigmaS(double t, RenderCounters& counters) const;
  /// What the media's controls say together: optical depth of the stretch, extinction at its end.
  FlightControl control() const;
  /// Density that a flight from tMin is taken to have for a collision at `t`, for weights: the mean over the
  /// channels of what the media's controls say together.
  double flightDensity(double t) const;
  /// Mean over the stretch and the channels of the extinction that the media's controls say together; on an
  /// endless one that at its end. 0 only where nothing can collide.
  double meanExtinction() const;
  /// Points chosen where active medium number `i` emits, with what all media let through of it.
  EmissionSamples sampleEmission(std::size_t i, PixelStream random, RenderCounters& counters) const;

 private:
  /// In the space of an active medium's definition.
  Segment segmentIn(const PlacedMedium& m) const;
  /// What sampleFlightOfLight says of the end.
  Rgb lightThrough(std::optional<std::size_t> source, PixelStream random, RenderCounters& counters) const;
  MediumFlight nearestOfFlights(Rgb throughput, PixelStream random, RenderCounters& counters) const;

  const MediumState* state_;
  const Ray* ray_;
  double tMin_, tMax_;
};

}  // namespace pbrtmedia
