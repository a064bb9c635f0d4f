// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/ray.h"
#include "base/statistics.h"
#include "world/scatter_point.h"
#include "world/scene.h"

namespace pbrtmedia {

/// The plane of a hit through `p`, its side that `toward` points to.
BoundaryPlane planeAt(const SceneHit& hit, const SurfaceInteraction& si, Vec3d p, Vector3f toward,
                      float time);

/// The point at `t` of a stretch of `ray` that begins at `start` and ends at tMax with `hit` (null: with
/// none), on the right side of both.
ScatterPoint scatterPointOn(const Scene& scene, const Ray& ray, double t, double tMax, const SceneHit* hit,
                            const BoundaryPlane& start, RenderCounters& counters);

}  // namespace pbrtmedia
