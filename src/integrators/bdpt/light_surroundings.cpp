// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/light_surroundings.h"

#include "world/boundary_planes.h"
#include "world/state_at_start.h"

namespace pbrtmedia {
namespace {

/// The line to a light on a surface goes this much farther, as a share of its length, so that rounding does
/// not end it before.
constexpr float kBeyond = 1e-3f;

}  // namespace

LightSurroundings surroundingsOf(const BdptSetup& setup, PrimitiveId target, bool isInfinite, const Ray& ray,
                                 Normal3f normal, Point3f camera, MediumState atCamera,
                                 SampleContext& context) {
  LightSurroundings found;
  if (target.isValid()) found.start.add(target, 0);
  if (!setup.media || isInfinite) return found;
  found.state = std::move(atCamera);
  if (!setup.scene.hasMediumBoundaries()) return found;
  Ray link;
  link.o = camera;
  const Vec3d d = Vec3d(ray.o) - Vec3d(camera);
  const double distance = length(d);
  if (!(distance > 0)) return found;
  link.d = Vector3f(d / distance);
  link.time = ray.time;
  link.tMax = static_cast<float>(distance) * (target.isValid() ? 1 + kBeyond : 1);
  MediaWalk walk(setup.walkContext(context), found.state, LineWalk(setup.scene, link, Exclusions{}));
  while (const auto hit = walk.next()) {
    if (!(hit->hit.id == target) || hit->t() < distance * (1 - double{kBeyond})) {
      walk.cross(*hit);
      continue;
    }
    const SurfaceInteraction si = setup.scene.surface(*hit, link);
    if (dot(si.n, link.d) * dot(normal, link.d) < 0) {  // the other side of a small light
      walk.cross(*hit, si);
      continue;
    }
    const CoincidentSurfaces coincident = walk.coincidentWith(*hit, si);
    setup.media->leaveSurface(found.state, *hit, si, coincident, ray.d, context.counters, context.mismatches);
    found.start = coincident.startingWith(target);
    if (!found.state.isVacuum()) found.plane = planeAt(*hit, si, Vec3d(ray.o), ray.d, ray.time);
    return found;
  }
  // A light that is not met from the camera: in its plane, at a hole of it, or hidden by rounding.
  if (target.isValid()) found.state = stateAtStart(*setup.media, ray, found.start, context.counters);
  return found;
}

}  // namespace pbrtmedia
