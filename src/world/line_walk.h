// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "world/coincident_surfaces.h"
#include "world/hit_queue.h"
#include "world/scene.h"

namespace pbrtmedia {

/// The hits along one ray in order, each primitive crossing once. Surfaces that change nothing
/// (Primitive::isInvisible) are passed silently. The ray itself never changes, so hits along it are ordered
/// consistently; the walk makes strict progress.
///
/// Where surfaces coincide, rounding decides which one is hit first. Their order is therefore chosen: a
/// surface with a material comes before boundaries without one (fog that ends on the floor is still there
/// above the floor), and of boundaries one that fits the media the ray is in comes first (one box is left
/// before the next is entered).
class LineWalk {
 public:
  /// `exclusions`: what the ray starts on or ends on. `scene` is borrowed.
  LineWalk(const Scene& scene, const Ray& ray, const Exclusions& exclusions)
      : scene_(scene), ray_(ray), fixed_(exclusions), exclusions_(exclusions) {}
  /// Of a ray from the camera. Surfaces with a material that hold its origin, up to rounding, are left out:
  /// PBRT-v3 takes no hit at distance 0. So are emitters, but not boundaries of media.
  static LineWalk fromCamera(const Scene& scene, const Ray& ray) {
    LineWalk walk(scene, ray, {});
    walk.isFromCamera_ = true;
    return walk;
  }
  const Ray& ray() const { return ray_; }

  /// The nearest of the hits to come, without choosing among those that coincide with it: where the stretch
  /// before them ends. What lies beyond is not looked for yet, which saves a query where the path ends on the
  /// way.
  std::optional<SceneHit> peek(std::uint64_t& queries) {
    if (ahead_.isEmpty() && !fetch(queries)) return std::nullopt;
    return ahead_.front();
  }
  /// The next hit; none when there is no further one before ray.tMax. `queries`: a counter of ray queries.
  /// `fits(hit)`: whether a boundary may come next; asked only where several coincide.
  template <class Fits>
  std::optional<SceneHit> next(std::uint64_t& queries, const Fits& fits) {
    const std::size_t group = lookAhead(queries);
    if (group == 0) return std::nullopt;
    std::size_t chosen = 0;
    if (group > 1 && !ahead_[group - 1].primitive->material) {
      while (chosen + 1 < group && !fits(ahead_[chosen])) ++chosen;
      if (!fits(ahead_[chosen])) chosen = 0;
    } else if (group > 1) {
      chosen = group - 1;
    }
    const SceneHit hit = ahead_[chosen];
    ahead_.erase(chosen);
    return hit;
  }
  std::optional<SceneHit> next(std::uint64_t& queries) {
    return next(queries, [](const SceneHit&) { return true; });
  }

  /// The surfaces with two different media that coincide with `hit` at `si`, which has a material and was
  /// delivered last. The walk ends with this.
  CoincidentSurfaces coincidentWith(const SceneHit& hit, const SurfaceInteraction& si,
                                    std::uint64_t& queries);

 private:
  bool coincide(const SceneHit& a, const SceneHit& b) const;
  /// Fills `ahead_` and returns how many of its first hits coincide; a surface with material ends such a
  /// group.
  std::size_t lookAhead(std::uint64_t& queries);
  bool fetch(std::uint64_t& queries);
  void advancePast(const RayHit& hit);
  bool holdsOrigin(const SceneHit& hit) const;
  void forgetBefore(float t);

  const Scene& scene_;
  Ray ray_;
  Exclusions fixed_, exclusions_;  ///< as given; with the crossings at tMin_ and beyond
  bool isFromCamera_ = false;
  float tMin_ = 0;
  bool ended_ = false;
  HitQueue ahead_;  ///< found but not yet delivered, in order of t
};

}  // namespace pbrtmedia
