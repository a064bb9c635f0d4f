// SPDX-License-Identifier: BSD-2-Clause
#include "world/boundary_planes.h"

#include "world/hit_coordinates.h"

namespace pbrtmedia {

BoundaryPlane planeAt(const SceneHit& hit, const SurfaceInteraction& si, Vec3d p, Vector3f toward,
                      float time) {
  return {true, p, Vec3d(faceForward(si.n, toward)), coordinatesOf(hit, time)};
}

ScatterPoint scatterPointOn(const Scene& scene, const Ray& ray, double t, double tMax, const SceneHit* hit,
                            const BoundaryPlane& start, RenderCounters& counters) {
  BoundaryPlane end;
  if (hit && tMax - t < kNearBoundary * (tMax + maxComponent(abs(ray.o)))) {
    end = planeAt(*hit, scene.surface(*hit, ray), Vec3d(ray.o) + tMax * Vec3d(ray.d), -ray.d, ray.time);
  }
  return scatterPoint(ray, t, start, end, counters);
}

}  // namespace pbrtmedia
