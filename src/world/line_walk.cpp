// SPDX-License-Identifier: BSD-2-Clause
#include "world/line_walk.h"

#include <algorithm>

#include "base/interruption.h"
#include "shapes/shape.h"
#include "world/hit_coordinates.h"

namespace pbrtmedia {
namespace {

/// Crossings are remembered over this share of the coordinates: a line through a common edge of two triangles
/// may hit both, some roundings apart or, where it grazes one, many of them, and the accelerator must see
/// that it is one crossing.
constexpr float kRemembered = 1e-2f;
/// Surfaces closer than this share of the coordinates coincide: some roundings of t.
constexpr float kCoincident = 0x1p-20f;
/// Where a ray grazes them, their hits may be farther apart along it: by 1 / cosine, at most this factor.
constexpr float kMostGrazing = 0x1p10f;
/// A surface closer to the camera than this share of the coordinates holds it: rounding of both.
constexpr double kHoldsOrigin = 0x1p-22;
/// Hits farther along the ray than this share are not looked at closely: only a saving of time.
constexpr float kNearOrigin = 1e-3f;

}  // namespace

/// Forgets crossings that lie behind `t`. What the ray starts or ends on stays left out: another query would
/// report it at a t that rounding decides.
void LineWalk::forgetBefore(float t) {
  const auto crossed = exclusions_.entries().subspan(fixed_.entries().size());
  if (std::ranges::all_of(crossed, [&](const Exclusions::Entry& e) { return e.t >= t; })) return;
  Exclusions kept = fixed_;
  for (const Exclusions::Entry& e : crossed) {
    if (e.t >= t) kept.add(e.id, e.t);
  }
  exclusions_ = kept;
}

void LineWalk::advancePast(const RayHit& hit) {
  // One float below t: shapes find their roots in double, and one that coincides may be rounded up to t.
  tMin_ = std::max(tMin_, std::nextafter(hit.t, 0.0f));
  forgetBefore(tMin_ - kRemembered * (tMin_ + maxComponent(abs(ray_.o))));
  if (exclusions_.add(hit.id, hit.t)) return;
  forgetBefore(tMin_);
  if (exclusions_.add(hit.id, hit.t)) return;
  // More coincident surfaces than can be left out one by one: the others at this very t are passed over.
  tMin_ = std::nextafter(hit.t, kInfinity);
  exclusions_ = fixed_;
  exclusions_.add(hit.id, hit.t);
}

bool LineWalk::holdsOrigin(const SceneHit& hit) const {
  if (hit.t() > kNearOrigin * scene_.largestCoordinate()) return false;
  if (!hit.primitive->material && !hit.primitive->media.same()) return false;
  const double size = std::max<double>(maxComponent(abs(ray_.o)), coordinatesOf(hit, ray_.time));
  return hit.t() * absDot(Vec3d(scene_.surface(hit, ray_).n), Vec3d(ray_.d)) <= kHoldsOrigin * size;
}

bool LineWalk::fetch(std::uint64_t& queries) {
  while (!ended_) {
    leaveIfAbandoned();  // the loops of all that walk along lines
    const std::optional<SceneHit> hit = scene_.closest(ray_, tMin_, exclusions_, queries);
    if (!hit) {
      ended_ = true;
      break;
    }
    advancePast(hit->hit);
    if (hit->primitive->isInvisible()) continue;
    if (isFromCamera_ && holdsOrigin(*hit)) continue;
    ahead_.add(*hit);
    return true;
  }
  return false;
}

/// Whether two hits in order are less apart than rounding, measured across their surfaces.
bool LineWalk::coincide(const SceneHit& a, const SceneHit& b) const {
  const float apart = b.t() - a.t(), rounding = kCoincident * (a.t() + maxComponent(abs(ray_.o)));
  if (apart <= rounding) return true;
  if (apart > kMostGrazing * rounding) return false;
  const float steepness =
      std::max(absDot(scene_.surface(a, ray_).n, ray_.d), absDot(scene_.surface(b, ray_).n, ray_.d));
  return apart * steepness <= rounding;
}

namespace {

/// Largest coordinate that had a part in the position of a hit.
float extentOf(const SceneHit& hit, Point3f p, float time) {
  float extent = maxComponent(abs(p));
  if (hit.placement) {
    const Vec3d origin = hit.placement->worldFromObject(time).point(Vec3d{});
    extent = std::max(extent, static_cast<float>(maxComponent(abs(origin))));
  }
  return extent;
}

}  // namespace

CoincidentSurfaces LineWalk::coincidentWith(const SceneHit& hit, const SurfaceInteraction& si,
                                            std::uint64_t& queries) {
  CoincidentSurfaces found;
  const auto isOther = [&](const SceneHit& other) {
    const bool isOwn =
        other.hit.id.instance == hit.hit.id.instance && other.hit.id.geometry == hit.hit.id.geometry;
    return !isOwn && !other.primitive->media.same();
  };
  // What `next` passed over coincides.
  for (std::size_t i = 0; i < ahead_.size(); ++i) {
    const SceneHit& other = ahead_[i];
    if (!isOther(other)) continue;
    const SurfaceInteraction at = scene_.surface(other, ray_);
    found.add({other, at.n, at.p});
  }
  ahead_.clear();
  ended_ = true;
  if (!scene_.mayTouchBoundary(si.p, hit)) return found;
  // Of what lies beyond, t alone says little where the ray comes from far away: points know more.
  const float steepness = std::max(absDot(si.n, ray_.d), 1 / kMostGrazing);
  const float reach = hit.t() + kCoincident * (hit.t() + maxComponent(abs(ray_.o))) / steepness;
  Ray near = ray_;
  near.tMax = std::min(ray_.tMax, std::nextafter(reach, kInfinity));
  while (const std::optional<SceneHit> other = scene_.closest(near, tMin_, exclusions_, queries)) {
    advancePast(other->hit);
    if (!isOther(*other)) continue;
    const SurfaceInteraction at = scene_.surface(*other, ray_);
    const Vector3f apart = at.p - si.p;
    const float rounding =
        kCoincident * std::max(extentOf(hit, si.p, ray_.time), extentOf(*other, at.p, ray_.time));
    if (std::max(absDot(apart, at.n), absDot(apart, si.n)) <= rounding) found.add({*other, at.n, at.p});
  }
  return found;
}

std::size_t LineWalk::lookAhead(std::uint64_t& queries) {
  if (ahead_.isEmpty() && !fetch(queries)) return 0;
  for (std::size_t i = 0;; ++i) {
    if (ahead_[i].primitive->material) return i + 1;
    // Looking one hit ahead costs nothing: whoever passes this boundary asks for the next hit anyway.
    if (i + 1 == ahead_.size() && !fetch(queries)) return i + 1;
    if (!coincide(ahead_.front(), ahead_[i + 1])) return i + 1;
  }
}

}  // namespace pbrtmedia
