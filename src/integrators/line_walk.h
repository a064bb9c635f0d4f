// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "integrators/scene.h"

namespace pbrtmedia {

/// The hits along one ray in order, each primitive crossing once. Hits at the same t are all found. Surfaces
/// that change nothing (Primitive::isInvisible) are passed silently. The ray itself never changes, so hits
/// along it are ordered consistently; the walk makes strict progress.
class LineWalk {
 public:
  /// `exclusions`: what the ray starts on or ends on. `scene` and `ray` are borrowed.
  LineWalk(const Scene& scene, const Ray& ray, const Exclusions& exclusions)
      : scene_(scene), ray_(ray), fixed_(exclusions), exclusions_(exclusions) {}

  /// The next hit; none when there is no further one before ray.tMax.
  std::optional<SceneHit> next(std::uint64_t& queries) {
    for (;;) {
      std::optional<SceneHit> hit = scene_.closest(ray_, tMin_, exclusions_, queries);
      if (!hit) return hit;
      advancePast(hit->hit);
      if (!hit->primitive->isInvisible()) return hit;
    }
  }

 private:
  void advancePast(const RayHit& hit);
  void forgetBefore(float t);

  const Scene& scene_;
  const Ray& ray_;
  Exclusions fixed_, exclusions_;  ///< as given; with the crossings at tMin_ and beyond
  float tMin_ = 0;
};

}  // namespace pbrtmedia
