// SPDX-License-Identifier: BSD-2-Clause
#include "world/camera_medium.h"

#include <algorithm>

#include "media/medium.h"
#include "world/boundary_sides.h"
#include "world/line_walk.h"
#include "world/probe_directions.h"

namespace pbrtmedia {
namespace {

/// What the boundaries along one line say about its start.
struct Finding {
  bool saysBoundary = false;  ///< some boundary names the medium on its near side
  bool isWeak = false;        ///< some of them have faults: holes, or normals that face inward
  MediumState state;
  bool saysSomething() const { return saysBoundary || state.enteredCount() > 0; }
};

/// Adds as many of each medium to the start as the ray later leaves without having entered it.
class PresenceCount {
 public:
  void leave(PlacedMedium m, MediumState& start) {
    if (!open_.leave(m)) start.enter(m);
  }
  void enter(PlacedMedium m) { open_.enter(m); }

 private:
  MediumState open_;
};

Finding probe(const Scene& scene, Point3f origin, float time, Vector3f direction) {
  Ray ray;
  ray.o = origin;
  ray.d = normalize(direction);
  ray.time = time;
  LineWalk walk(scene, ray, Exclusions{});
  Finding finding;
  PresenceCount presence;
  std::uint64_t queries = 0;
  while (const auto hit = walk.next(queries)) {
    if (hit->primitive->media.same()) continue;
    finding.isWeak = finding.isWeak || scene.boundaries().faultOf(*hit->primitive);
    const BoundarySides sides(*hit, dot(ray.d, scene.surface(*hit, ray).n) > 0);
    if (sides.nearIsPresent) presence.leave(sides.near, finding.state);
    if (sides.farIsPresent) presence.enter(sides.far);
    if (sides.nearNamesBoundary() && !finding.saysBoundary) {
      finding.saysBoundary = true;
      finding.state.setBoundary(sides.near);
    }
  }
  return finding;
}

/// The outcome of most probes; those that met no boundary count only if all are such.
struct Verdict {
  MediumState state;
  std::size_t agreeing = 0, asked = 0;
  bool isSurrounded = false;  ///< every direction met a boundary, and they agree
};

Verdict askGeometry(const Scene& scene, Point3f origin, float time) {
  std::vector<Finding> findings;
  findings.reserve(kProbeDirections.size());
  for (const Vector3f d : kProbeDirections) findings.push_back(probe(scene, origin, time, d));
  const auto saysSomething = [](const Finding& f) { return f.saysSomething(); };
  auto says = static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), saysSomething));
  if (says < findings.size()) {
    // The camera is not surrounded: boundaries with faults are no evidence of what is around it.
    for (Finding& f : findings) {
      if (f.isWeak) f = {};
    }
    says = static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), saysSomething));
  }
  // A direction that meets no boundary is no evidence.
  Verdict verdict;
  for (const Finding& candidate : findings) {
    if (says > 0 && !saysSomething(candidate)) continue;
    const auto votes = static_cast<std::size_t>(std::count_if(
        findings.begin(), findings.end(), [&](const Finding& f) { return f.state == candidate.state; }));
    if (votes > verdict.agreeing) verdict.state = candidate.state, verdict.agreeing = votes;
  }
  verdict.asked = says > 0 ? says : findings.size();
  verdict.isSurrounded = says == findings.size() && verdict.agreeing == findings.size();
  return verdict;
}

}  // namespace

CameraMedium::CameraMedium(const Scene& scene, Point3f origin, float time, std::optional<const Medium*> given)
    : place_(origin), given_(given) {
  if (!given && scene.hasMediumBoundaries()) origin_ = origin;
  Verdict found;
  if (scene.hasMediumBoundaries()) found = askGeometry(scene, origin, time);
  state_ = found.state;
  if (!given) {
    if (found.agreeing < found.asked) {
      warnings_.push_back("the boundaries around the camera do not agree about the medium it is in: " +
                          std::to_string(found.agreeing) + " of " + std::to_string(found.asked) +
                          " directions say " + state_.describe() + ", which is used");
    }
    return;
  }
  const Medium* const medium = *given;
  const std::string name = medium ? '"' + medium->name() + '"' : "vacuum";
  if (isPresent(medium)) {
    for (std::size_t i = 0; i < state_.enteredCount(); ++i) {
      if (state_.entered(i).medium == medium) return;
    }
    state_.enter({medium, nullptr});
    return;
  }
  if (medium && state_.boundary().medium == medium) return;  // geometry also knows the placement
  if (found.isSurrounded && state_.boundary().medium != medium) {
    warnings_.push_back("the camera's medium is given as " + name +
                        ", but the boundaries all around the camera say " + state_.describe() +
                        "; camera rays start in " + name);
  }
  state_.setBoundary({medium, nullptr});
}

}  // namespace pbrtmedia
