// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/connecting_way.h"

namespace pbrtmedia {
namespace {

/// The way stops short of its end by this share of its length, some roundings of a hit's t, so that
/// neighbours of the surface there, in its own plane, do not block it.
constexpr float kEndMargin = 0x1p-18f;

Exclusions exclusionsOf(const PathVertex& from, const ConnectingWay& way) {
  Exclusions left = from.isOnSurface() ? from.coincident.startingWith(from.hit.hit.id) : Exclusions{};
  left.add(way.target, way.length);
  if (way.end && way.end->isOnSurface()) {
    left.add(way.end->hit.hit.id, way.length);
    for (const CoincidentSurfaces::Entry& e : way.end->coincident) left.add(e.hit.hit.id, way.length);
  }
  return left;
}

/// Where the last stretch begins when it ends at a scattering close to the boundary that was crossed: heights
/// above that are known better than positions.
double startOf(const MediaWalk& walk, const ConnectingWay& way) {
  if (!way.end || way.end->isOnSurface() || !(walk.t() > 0)) return walk.t();
  const double length = walk.tEnd() - walk.t();
  return walk.tEnd() - way.end->at.endAlong(-way.d, length);
}

}  // namespace

WayThrough wayThrough(const BdptSetup& setup, const PathVertex& from, const ConnectingWay& way, float time,
                      SampleContext& context) {
  Ray ray;
  ray.o = from.p;
  ray.d = way.d;
  ray.time = time;
  ray.tMax = way.length < kInfinity ? way.length * (1 - kEndMargin) : kInfinity;
  const Exclusions left = exclusionsOf(from, way);
  RenderCounters& counters = context.counters;
  WayThrough through{Rgb(1.0f), Rgb()};
  if (!setup.media) {
    if (setup.scene.occluded(ray, 0, left, counters.shadowRays, way.hider)) through.transmittance = Rgb();
    return through;
  }
  MediumState state = from.state;
  if (from.isOnSurface()) {
    setup.media->leaveSurface(state, from.hit, from.si, from.coincident, way.d, counters, context.mismatches);
  }
  MediaWalk walk(setup.shadowContext(context), state, LineWalk(setup.scene, ray, left),
                 from.isOnSurface() ? nullptr : &from.at);
  const auto blocks = [&](const SceneHit& h) { return h.primitive->material || h.isHider(way.hider); };
  for (;;) {
    const SceneHit* const nearest = walk.ahead();
    if (nearest && blocks(*nearest)) return {};
    if (!state.isVacuum()) {
      const MediaStretch stretch(state, walk.ray(), nearest ? walk.t() : startOf(walk, way), walk.tEnd());
      through.transmittance *= stretch.transmittance(context.stream(), counters);
      if (through.transmittance.isBlack()) return {};
      through.depth += stretch.control().depth;
    }
    const std::optional<SceneHit> hit = walk.next();
    if (!hit) return through;
    if (blocks(*hit)) return {};
    walk.cross(*hit);
  }
}

}  // namespace pbrtmedia
