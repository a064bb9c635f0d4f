// SPDX-License-Identifier: BSD-2-Clause
#include "world/media_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "media/medium.h"
#include "spectrum/rgb.h"
#include "world/boundary_sides.h"

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

Segment segmentOf(const PlacedMedium& m, const Ray& ray, double tMin, double tMax) {
  const Segment segment{ray.o, ray.d, tMin, tMax};
  return m.placement ? m.placement->toObject(segment, ray.time) : segment;
}

}  // namespace

std::string MediumMismatch::toString() const {
  std::ostringstream out;
  out << "pixel " << pixel.x << ' ' << pixel.y << ", sample " << sample << ": a boundary ";
  if (boundary && boundary->location.file) out << '(' << boundary->location.toString() << ") ";
  out << "at " << p << " has " << named << " on the side of a ray that is in " << believed;
  return out.str();
}

MediaTracker::MediaTracker(const Scene& scene, const Medium* cameraMedium)
    : boundaries_(scene.boundaries()), cameraMedium_(cameraMedium) {}

bool MediaTracker::fits(const MediumState& state, const Meeting& at) {
  return at.hit->primitive->media.same() || !contradicts(state, BoundarySides(*at.hit, at.towardOutside));
}

void MediaTracker::pass(MediumState& state, const Meeting& at, RenderCounters& counters, MismatchLog* log) {
  if (at.hit->primitive->media.same()) return;
  const BoundarySides s(*at.hit, at.towardOutside);
  if (contradicts(state, s)) noteMismatch(state, s, *at.hit->primitive, at.p, counters, log);
  if (s.nearIsPresent) state.leave(s.near);
  if (s.farIsPresent) state.enter(s.far);
  if (s.farNamesBoundary()) state.setBoundary(s.far);
}

void MediaTracker::cross(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si, Vector3f d,
                         RenderCounters& counters, MismatchLog* log) const {
  pass(state, {&hit, si.p, dot(d, si.n) > 0}, counters, log);
}

bool MediaTracker::fits(const MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
                        Vector3f d) const {
  return fits(state, {&hit, si.p, dot(d, si.n) > 0});
}

/// Whether a path along `d` has `near` as its boundary medium behind coincident surfaces that fit.
bool MediaTracker::reaches(MediumState state, PlacedMedium near, const CoincidentSurfaces& coincident,
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

void MediaTracker::leaveSurface(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
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

void MediaTracker::leaveAll(MediumState& state, const SceneHit& hit, const SurfaceInteraction& si,
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

void MediaTracker::escape(MediumState& state, RenderCounters& counters) const {
  if (state.isVacuum() || boundaries_.confinesNothing()) return;
  bool repaired = false;
  if (isConfined(state.boundary().medium)) {
    state.setBoundary(isPresent(cameraMedium_) ? PlacedMedium{} : PlacedMedium{cameraMedium_, nullptr});
    repaired = true;
  }
  for (std::size_t i = state.enteredCount(); i-- > 0;) {
    if (!isConfined(state.entered(i).medium)) continue;
    state.leave(state.entered(i));
    repaired = true;
  }
  if (repaired) ++counters.boundaryRepairs;
}

Rgb MediaTracker::transmittance(const MediumState& state, const Ray& ray, double tMin, double tMax,
                                PixelStream random, RenderCounters& counters) {
  Rgb product(1.0f);
  for (std::size_t i = 0; i < state.activeCount() && !product.isBlack(); ++i) {
    const PlacedMedium m = state.active(i);
    product *= m.medium->transmittance(segmentOf(m, ray, tMin, tMax), random, counters);
  }
  return product;
}

namespace {

/// Independent free flights through several media. The nearest collision counts. What another medium let
/// through up to there is told by the same flight on the shorter segment: as a flight draws its random
/// numbers on the way (Medium::sampleFreeFlight), a replay of its numbers takes the same steps and passes.
MediumFlight nearestOfFlights(const MediumState& state, const Ray& ray, double tMin, double tMax,
                              Rgb throughput, PixelStream random, RenderCounters& counters) {
  struct Flight {
    Rng start;
    Rgb passed;
    double tEnd;
  };
  std::vector<Flight> flights;
  flights.reserve(state.activeCount());
  MediumFlight nearest;
  Rgb collidedWeight(1.0f);
  std::size_t winner = state.activeCount();
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    const PlacedMedium m = state.active(i);
    const Rng start = random.rng();
    const FreeFlight f =
        m.medium->sampleFreeFlight(segmentOf(m, ray, tMin, tMax), throughput, random, counters);
    flights.push_back({start, f.weight, tMax});
    if (!f.collided) continue;
    tMax = f.t;
    winner = i;
    collidedWeight = f.weight;
    nearest = {true, f.t, Rgb(1.0f), &m.medium->phase()};
  }
  for (std::size_t i = 0; i < flights.size(); ++i) {
    if (i == winner) {
      nearest.weight *= collidedWeight;
      continue;
    }
    const PlacedMedium m = state.active(i);
    if (flights[i].tEnd != tMax) {
      Rng replay = flights[i].start;
      const FreeFlight f =
          m.medium->sampleFreeFlight(segmentOf(m, ray, tMin, tMax), throughput, replay, counters);
      // It may collide only by rounding at the very end; then it got there all the same.
      flights[i].passed = f.collided ? Rgb(1.0f) : f.weight;
    }
    nearest.weight *= flights[i].passed;
  }
  return nearest;
}

}  // namespace

MediumFlight MediaTracker::sampleFreeFlight(const MediumState& state, const Ray& ray, double tMin,
                                            double tMax, Rgb throughput, PixelStream random,
                                            RenderCounters& counters) {
  if (state.isVacuum()) return {};
  if (state.activeCount() > 1) return nearestOfFlights(state, ray, tMin, tMax, throughput, random, counters);
  const PlacedMedium m = state.active(0);
  const FreeFlight f =
      m.medium->sampleFreeFlight(segmentOf(m, ray, tMin, tMax), throughput, random, counters);
  return {f.collided, f.t, f.weight, f.collided ? &m.medium->phase() : nullptr};
}

Rgb MediaTracker::scattering(const MediumState& state, const Ray& ray, double t, Vector3f wo, Vector3f wi,
                             RenderCounters& counters) {
  Rgb sum;
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    const PlacedMedium m = state.active(i);
    const Rgb sigmaS = m.medium->at(segmentOf(m, ray, t, t).at(t), counters).sigmaS;
    if (!sigmaS.isBlack()) sum += sigmaS * m.medium->phase().evaluate(wo, wi);
  }
  return sum;
}

namespace {

FlightControl controlOf(const MediumState& state, const Ray& ray, double tMin, double t) {
  FlightControl sum{};
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    const PlacedMedium m = state.active(i);
    const FlightControl control = m.medium->flightControl(segmentOf(m, ray, tMin, t));
    sum.depth += control.depth;
    sum.rate += control.rate;
  }
  return sum;
}

}  // namespace

double MediaTracker::meanExtinction(const MediumState& state, const Ray& ray, double tMin, double tMax) {
  const FlightControl control = controlOf(state, ray, tMin, tMax);
  const double length = tMax - tMin;
  const auto depth = static_cast<double>(control.depth.average());
  if (length < static_cast<double>(kInfinity)) return length > 0 ? depth / length : 0;
  const auto rate = static_cast<double>(control.rate.average());
  return rate > 0 || !(depth > 0) ? rate : std::numeric_limits<double>::min();
}

double MediaTracker::flightDensity(const MediumState& state, const Ray& ray, double tMin, double t) {
  const auto [depth, rate] = controlOf(state, ray, tMin, t);
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (rate[c] > 0) sum += static_cast<double>(rate[c]) * std::exp(-static_cast<double>(depth[c]));
  }
  return sum / 3;
}

bool MediaTracker::isExponential(const MediumState& state) {
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    if (!state.active(i).medium->isExponential()) return false;
  }
  return true;
}

bool MediaTracker::emits(const MediumState& state) {
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    if (state.active(i).medium->isEmissive()) return true;
  }
  return false;
}

EmissionSamples MediaTracker::sampleEmission(const MediumState& state, std::size_t i, const Ray& ray,
                                             double tMin, double tMax, PixelStream random,
                                             RenderCounters& counters) {
  const PlacedMedium m = state.active(i);
  EmissionSamples found = m.medium->sampleEmission(segmentOf(m, ray, tMin, tMax), random, counters);
  for (std::size_t s = 0; s < found.count; ++s) {
    auto& [t, radiance] = found.samples[s];
    for (std::size_t other = 0; other < state.activeCount() && !radiance.isBlack(); ++other) {
      if (other == i) continue;
      const PlacedMedium o = state.active(other);
      radiance *= o.medium->transmittance(segmentOf(o, ray, tMin, t), random, counters);
    }
  }
  return found;
}

}  // namespace pbrtmedia
