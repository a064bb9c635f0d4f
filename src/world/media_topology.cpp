// SPDX-License-Identifier: BSD-2-Clause
#include "world/media_topology.h"

#include <algorithm>
#include <array>
#include <utility>

#include "media/medium.h"
#include "world/boundary_sides.h"
#include "world/media_walk.h"

namespace pbrtmedia {
namespace {

std::string nameOf(const Medium* m) { return m ? '"' + m->name() + '"' : "vacuum"; }

bool contradicts(const MediumState& state, const BoundarySides& s) {
  if (s.nearIsPresent) return state.count(s.near) == 0;
  return s.nearNamesBoundary() && !(state.boundary() == s.near);
}

void noteMismatch(const MediumState& state, const BoundarySides& sides, const Primitive& boundary, Point3f p,
                  RenderCounters& counters, MismatchLog* log) {
  ++counters.mediumMismatches;
  if (!log || log->entries.size() >= log->capacity) return;
  log->entries.push_back(
      {log->pixel, log->sample, p, state.describe(), nameOf(sides.near.medium), &boundary});
}

}  // namespace

MediaTopology::MediaTopology(const Scene& scene, CameraMedium camera)
    : scene_(scene), camera_(std::move(camera)) {}

bool MediaTopology::hasMedia() const { return scene_.hasMediumBoundaries() || !camera_.state().isVacuum(); }

bool MediaTopology::hasEmission() const { return scene_.hasEmissiveMedia() || camera_.state().isEmissive(); }

bool MediaTopology::isConfined(const Medium* medium) const {
  return medium != camera_.given() && scene_.boundaries().isConfined(medium);
}

MediumState MediaTopology::stateOf(const Ray& ray, RenderCounters& counters) const {
  const std::optional<Point3f> origin = camera_.origin();
  return origin ? stateBehind(*origin, ray.o, ray.time, counters) : camera_.state();
}

MediumState MediaTopology::stateAt(Point3f p, float time, RenderCounters& counters) const {
  return scene_.hasMediumBoundaries() ? stateBehind(camera_.place(), p, time, counters) : camera_.state();
}

/// The camera's state behind the boundaries on the line from it to `p`.
MediumState MediaTopology::stateBehind(Point3f camera, Point3f p, float time,
                                       RenderCounters& counters) const {
  MediumState state = camera_.state();
  if (p == camera) return state;
  const Vector3f offset = p - camera;
  Ray link;
  link.o = camera;
  link.tMax = length(offset);
  link.d = offset / link.tMax;
  link.time = time;
  MediaWalk({scene_, this, counters, counters.rays}, state, LineWalk(scene_, link, Exclusions{})).crossAll();
  return state;
}

bool MediaTopology::fits(const MediumState& state, const Meeting& at) {
  return at.hit->primitive->media.same() || !contradicts(state, BoundarySides(*at.hit, at.towardOutside));
}

void MediaTopology::pass(MediumState& state, const Meeting& at, RenderCounters& counters, MismatchLog* log) {
  if (at.hit->primitive->media.same()) return;
  const BoundarySides s(*at.hit, at.towardOutside);
  if (contradicts(state, s)) noteMismatch(state, s, *at.hit->primitive, at.p, counters, log);
  if (s.nearIsPresent) state.leave(s.near);
  if (s.farIsPresent) state.enter(s.far);
  if (s.farNamesBoundary()) state.setBoundary(s.far);
}

void MediaTopology::cross(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si, Vector3f d,
                          RenderCounters& counters, MismatchLog* log) const {
  pass(state, {&hit, si.p, dot(d, si.n) > 0}, counters, log);
}

bool MediaTopology::fits(const MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
                         Vector3f d) const {
  return fits(state, {&hit, si.p, dot(d, si.n) > 0});
}

/// Whether a path along `d` has `near` as its boundary medium behind coincident surfaces that fit.
bool MediaTopology::reaches(MediumState state, PlacedMedium near, const CoincidentSurfaces& coincident,
                            Vector3f d) {
  RenderCounters uncounted;
  std::array<bool, CoincidentSurfaces::kCapacity> passed{};
  for (bool goesOn = true; goesOn && !(state.boundary() == near);) {
    goesOn = false;
    std::size_t i = 0;
    for (const CoincidentSurfaces::Entry& e : coincident) {
      const Meeting at{&e.hit, e.p, dot(d, e.n) > 0};
      bool& isPassed = passed[i++];
      if (isPassed || !fits(state, at)) continue;
      pass(state, at, uncounted, nullptr);
      isPassed = goesOn = true;
    }
  }
  return state.boundary() == near;
}

void MediaTopology::leaveSurface(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
                                 const CoincidentSurfaces& coincident, Vector3f wi, RenderCounters& counters,
                                 MismatchLog* log) const {
  if (!coincident.isEmpty()) return leaveAll(state, hit, si, coincident, wi, counters, log);
  if (hit.primitive->media.same()) return;
  const bool goesOutside = dot(wi, si.n) > 0, cameFromOutside = dot(si.wo, si.n) > 0;
  if (goesOutside != cameFromOutside) return pass(state, {&hit, si.p, goesOutside}, counters, log);
  const BoundarySides s(hit, !goesOutside);
  if (!s.nearNamesBoundary() || state.boundary() == s.near) return;
  noteMismatch(state, s, *hit.primitive, si.p, counters, log);
  state.setBoundary(s.near);
}

void MediaTopology::leaveAll(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
                             const CoincidentSurfaces& coincident, Vector3f wi, RenderCounters& counters,
                             MismatchLog* log) {
  const auto crosses = [&](Normal3f n) { return (dot(wi, n) > 0) != (dot(si.wo, n) > 0); };
  const auto meeting = [&](const SceneHit& at, Point3f p, Normal3f n) {
    return Meeting{&at, p, dot(wi, n) > 0};
  };
  std::array<Meeting, CoincidentSurfaces::kCapacity + 1> ahead;
  std::size_t count = 0;
  if (crosses(si.n)) {
    ahead[count++] = meeting(hit, si.p, si.n);
  } else if (!hit.primitive->media.same()) {
    const BoundarySides s(hit, !(dot(wi, si.n) > 0));
    if (s.nearNamesBoundary() && !reaches(state, s.near, coincident, -si.wo)) {
      noteMismatch(state, s, *hit.primitive, si.p, counters, log);
      state.setBoundary(s.near);
    }
  }
  for (const CoincidentSurfaces::Entry& e : coincident) {
    if (crosses(e.n)) ahead[count++] = meeting(e.hit, e.p, e.n);
  }
  for (auto *left = ahead.data(), *end = left + count; left != end; ++left) {
    auto* next = std::find_if(left, end, [&](const Meeting& m) { return fits(state, m); });
    if (next == end) next = left;
    pass(state, *next, counters, log);
    *next = *left;
  }
}

void MediaTopology::escape(MediumState& state, RenderCounters& counters) const {
  if (state.isVacuum() || scene_.boundaries().confinesNothing()) return;
  bool repaired = false;
  if (isConfined(state.boundary().medium)) {
    const Medium* const around = camera_.given();
    state.setBoundary(isPresent(around) ? PlacedMedium{} : PlacedMedium{around, nullptr});
    repaired = true;
  }
  for (std::size_t i = state.enteredCount(); i-- > 0;) {
    if (!isConfined(state.entered(i).medium)) continue;
    state.leave(state.entered(i));
    repaired = true;
  }
  if (repaired) ++counters.boundaryRepairs;
}

}  // namespace pbrtmedia
