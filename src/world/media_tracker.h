// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "base/pixel_stream.h"
#include "media/medium.h"
#include "media/phase/phase_function.h"
#include "spectrum/rgb.h"
#include "world/coincident_surfaces.h"
#include "world/medium_state.h"

namespace pbrtmedia {

/// A crossing where a boundary contradicts the ray's current medium; the first few are shown to the user.
struct MediumMismatch {
  Point2i pixel;
  std::int64_t sample = 0;
  Point3f p;  ///< world
  std::string believed, named;
  const Primitive* boundary = nullptr;  ///< of the scene
  /// pixel 3 4, sample 0: a boundary at (...) has "fog" on the side of a ray that is in "smoke"
  std::string toString() const;
};

/// Where the first mismatches of one pixel sample or of a tile are noted down. Not thread-safe.
struct MismatchLog {
  Point2i pixel;
  std::int64_t sample = 0;
  std::size_t capacity = 4;
  std::vector<MediumMismatch> entries;
};

/// Outcome of a free flight through all media of a state.
struct MediumFlight {
  bool collided = false;
  double t = 0;
  Rgb weight{1.0f};                      ///< as in FreeFlight
  const PhaseFunction* phase = nullptr;  ///< of the medium that collided
};

/// Media topology of one scene: how crossing boundaries changes the media a path is in. Immutable,
/// thread-safe.
class MediaTracker {
 public:
  /// `cameraMedium`: the explicit start medium, if the scene gives one; it may then reach infinity.
  explicit MediaTracker(const Scene& scene, const Medium* cameraMedium = nullptr);

  /// Changes `state` for going through the surface along `d`. `normal`: geometric, world space. A boundary
  /// whose near side contradicts the state is counted and noted in `log` (may be null); the boundary wins.
  void cross(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si, Vector3f d,
             RenderCounters& counters, MismatchLog* log) const;
  /// Whether crossing the surface along `d` would not contradict the state.
  bool fits(const MediumState& state, const SceneHit& hit, const SurfaceInteraction& si, Vector3f d) const;
  /// State of a ray that starts on the surface along `wi`, when a path in `state` came in from si.wo. Of the
  /// surface and of those that coincide with it, the path crosses those that it leaves on the other side than
  /// it came from, in an order in which each fits the media so far, if there is one.
  void leaveSurface(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
                    const CoincidentSurfaces& coincident, Vector3f wi, RenderCounters& counters,
                    MismatchLog* log) const;
  /// To be called when a ray has no further hit: media that closed boundaries confine cannot be there.
  /// Removes them and counts a boundary repair.
  void escape(MediumState& state, RenderCounters& counters) const;

  /// Unbiased estimate of the transmittance of all active media over tMin < t < tMax of the world ray; their
  /// product. Stops as soon as it is black.
  static Rgb transmittance(const MediumState& state, const Ray& ray, double tMin, double tMax,
                           PixelStream random, RenderCounters& counters);
  /// The nearest of independent free flights through the active media, weighted by what the other media let
  /// through up to there.
  /// `throughput`: of the path so far (Medium::sampleFreeFlight).
  static MediumFlight sampleFreeFlight(const MediumState& state, const Ray& ray, double tMin, double tMax,
                                       Rgb throughput, PixelStream random, RenderCounters& counters);
  /// What the media scatter at `t` from `wi` toward `wo` per length: the sum of sigma_s times the phase
  /// function. `wi` away from the point, as `wo`.
  static Rgb scattering(const MediumState& state, const Ray& ray, double t, Vector3f wo, Vector3f wi,
                        RenderCounters& counters);
  /// Density that a flight from tMin is taken to have for a collision at `t`, for weights: the mean over the
  /// channels of what the media's controls say together.
  static double flightDensity(const MediumState& state, const Ray& ray, double tMin, double t);
  /// Mean over the stretch and the channels of the extinction that the media's controls say together; on an
  /// endless one that at its end. 0 only where nothing can collide.
  static double meanExtinction(const MediumState& state, const Ray& ray, double tMin, double tMax);
  /// Whether all active media follow the exponential law.
  static bool isExponential(const MediumState& state);
  /// Whether some active medium emits.
  static bool emits(const MediumState& state);
  /// Points of the segment chosen where active medium number `i` emits, with what all media let through of
  /// it.
  static EmissionSamples sampleEmission(const MediumState& state, std::size_t i, const Ray& ray, double tMin,
                                        double tMax, PixelStream random, RenderCounters& counters);
  /// Whether the medium can be only within closed boundaries.
  bool isConfined(const Medium* medium) const {
    return medium != cameraMedium_ && boundaries_.isConfined(medium);
  }

 private:
  /// A surface and the side that it is met from.
  struct Meeting {
    const SceneHit* hit;
    Point3f p;
    bool towardOutside;
  };
  static bool fits(const MediumState& state, const Meeting& at);
  static void pass(MediumState& state, const Meeting& at, RenderCounters& counters, MismatchLog* log);
  /// `leaveSurface` where others coincide.
  static void leaveAll(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
                       const CoincidentSurfaces& coincident, Vector3f wi, RenderCounters& counters,
                       MismatchLog* log);
  static bool reaches(MediumState state, PlacedMedium near, const CoincidentSurfaces& coincident, Vector3f d);

  const BoundaryClosure& boundaries_;
  const Medium* cameraMedium_;
};

}  // namespace pbrtmedia
