// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/statistics.h"
#include "world/camera_medium.h"
#include "world/coincident_surfaces.h"
#include "world/medium_mismatch.h"
#include "world/medium_state.h"
#include "world/scene.h"

namespace pbrtmedia {

/// What media are where in a scene: which boundaries confine them, what is around the camera, and how
/// crossing a boundary changes what a path is in (MediumState). Immutable, thread-safe; borrows the scene.
class MediaTopology {
 public:
  /// A medium that `camera` was given may reach infinity.
  explicit MediaTopology(const Scene& scene, CameraMedium camera = {});

  /// Whether there is any medium.
  bool hasMedia() const;
  /// Whether some medium may emit.
  bool hasEmission() const;
  /// Whether the medium can be only within closed boundaries.
  bool isConfined(const Medium* medium) const;
  const Scene& scene() const { return scene_; }
  const CameraMedium& camera() const { return camera_; }
  /// Start state of a camera ray. Where geometry decides and the ray does not start where the camera is
  /// (lens, orthographic and moving cameras), the boundaries between the two are crossed.
  MediumState stateOf(const Ray& ray, RenderCounters& counters) const;
  /// State of any point of space, off all boundaries, at a time of the scene: the boundaries between it and
  /// the camera are crossed, wherever camera rays start. A walk over all surfaces in between.
  MediumState stateAt(Point3f p, float time, RenderCounters& counters) const;

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
  MediumState stateBehind(Point3f camera, Point3f p, float time, RenderCounters& counters) const;
  static bool reaches(MediumState state, PlacedMedium near, const CoincidentSurfaces& coincident, Vector3f d);

  const Scene& scene_;
  CameraMedium camera_;
};

}  // namespace pbrtmedia
