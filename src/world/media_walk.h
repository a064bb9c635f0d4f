// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <optional>

#include "world/line_walk.h"
#include "world/media_stretch.h"
#include "world/media_topology.h"
#include "world/scatter_point.h"

namespace pbrtmedia {

/// A ray on its way through surfaces, and the media that it is in between them. Every walk along a line is
/// one of these: stretches of constant media, each with the surface at its end.
///
///   while (...) {
///     walk.ahead();                      // the stretch at hand is [walk.t(), walk.tEnd()]
///     const auto hit = walk.next();      // the surface at its end; none: the ray ends
///     walk.cross(*hit);                  // behind it
///   }
///
/// Owns its ray; the state is that of whoever walks. Not thread-safe.
class MediaWalk {
 public:
  /// What a walk takes part in.
  struct Context {
    const Scene& scene;
    const MediaTopology* media;  ///< null: media are ignored
    RenderCounters& counters;
    std::uint64_t& queries;             ///< of rays, counted here
    MismatchLog* mismatches = nullptr;  ///< of boundaries; null: not noted
  };
  /// `state`: of the media at the line's start, kept up to date. `from`: where the line starts, if that is a
  /// scattering in a medium.
  MediaWalk(const Context& context, MediumState& state, LineWalk line, const ScatterPoint* from = nullptr)
      : context_(context), state_(&state), line_(std::move(line)) {
    if (from && from->near.isValid) from_ = *from;
  }
  /// The rest of another walk for somebody with a state of his own.
  MediaWalk(const MediaWalk& walk, const Context& context, MediumState& state)
      : context_(context),
        state_(&state),
        line_(walk.line_),
        from_(walk.from_),
        nearest_(walk.nearest_),
        t_(walk.t_),
        tEnd_(walk.tEnd_) {}
  MediaWalk(const MediaWalk&) = delete;
  MediaWalk& operator=(const MediaWalk&) = delete;

  const Ray& ray() const { return line_.ray(); }
  const MediumState& state() const { return *state_; }
  double t() const { return t_; }        ///< where the stretch at hand begins
  double tEnd() const { return tEnd_; }  ///< where it ends; after `ahead`
  /// The stretch at hand; after `ahead`, until the walk goes on.
  MediaStretch stretch() const { return {*state_, ray(), t_, tEnd_}; }

  /// Finds the end of the stretch at hand: the nearest surface, null when there is none before the end of the
  /// ray. Behind the last surface of an endless ray confined media cannot be.
  const SceneHit* ahead() {
    nearest_ = line_.peek(context_.queries);
    tEnd_ = nearest_ ? nearest_->t() : ray().tMax;
    if (nearest_ && from_) tEnd_ = from_->endAlong(ray().d, tEnd_);
    tEnd_ = std::max(t_, tEnd_);
    if (!nearest_ && context_.media && ray().tMax == kInfinity)
      context_.media->escape(*state_, context_.counters);
    return nearest_ ? &*nearest_ : nullptr;
  }
  /// The surface that comes next: of those that coincide at the end of the stretch, one that fits the media.
  std::optional<SceneHit> next() {
    return line_.next(context_.queries, [&](const SceneHit& h) {
      return !context_.media || context_.media->fits(*state_, h, context_.scene.surface(h, ray()), ray().d);
    });
  }
  /// Goes on behind the surface delivered last, `si` on the ray.
  void cross(const SceneHit& hit, const SurfaceInteraction& si) {
    if (context_.media)
      context_.media->cross(*state_, hit, si, ray().d, context_.counters, context_.mismatches);
    goOn();
  }
  void cross(const SceneHit& hit) {
    if (context_.media && !hit.primitive->media.same()) {
      cross(hit, context_.scene.surface(hit, ray()));
    } else {
      goOn();
    }
  }
  /// Through all surfaces to the end of the ray, whatever material they have.
  void crossAll() {
    while (const auto hit = next()) cross(*hit);
    if (context_.media && ray().tMax == kInfinity) context_.media->escape(*state_, context_.counters);
  }
  /// LineWalk::coincidentWith. The walk ends with this.
  CoincidentSurfaces coincidentWith(const SceneHit& hit, const SurfaceInteraction& si) {
    return line_.coincidentWith(hit, si, context_.queries);
  }

 private:
  void goOn() {
    t_ = tEnd_;
    from_.reset();
  }

  Context context_;
  MediumState* state_;
  LineWalk line_;
  std::optional<ScatterPoint> from_;  ///< on the first stretch
  std::optional<SceneHit> nearest_;
  double t_ = 0, tEnd_ = 0;
};

}  // namespace pbrtmedia
