// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/line_walk.h"

#include <algorithm>
#include <array>
#include <span>

namespace pbrtmedia {
namespace {

/// Crossings are remembered over this share of the coordinates: a line through a common edge of two triangles
/// may hit both, some roundings apart, and the accelerator must see that it is one crossing.
constexpr float kRemembered = 1e-4f;
/// Hits closer than this share of the coordinates coincide: some roundings of t.
constexpr float kCoincident = 0x1p-20f;
/// A surface closer to the camera than this share of the coordinates holds it: rounding of both.
constexpr double kHoldsOrigin = 0x1p-22;
/// Hits farther along the ray than this share are not looked at closely: only a saving of time.
constexpr float kNearOrigin = 1e-3f;

/// The largest coordinate that the surface at a hit is computed from, world space.
double coordinatesOf(const SceneHit& hit, float time) {
  const Shape& shape = *hit.primitive->shape;
  std::array<Point3f, 8> corners;
  std::size_t count = 3;
  const Shape::Geometry geometry = shape.geometry();
  if (const auto* triangles = std::get_if<TriangleBuffers>(&geometry)) {
    for (std::size_t i = 0; i < count; ++i) {
      corners[i] = triangles->positions[triangles->indices[hit.hit.id.primitive][i]];
    }
  } else {
    const Bounds3f bounds = shape.bounds();
    for (count = 0; count < corners.size(); ++count) corners[count] = bounds.corner(static_cast<int>(count));
  }
  Transform place;
  if (hit.placement) place = hit.placement->worldFromObject(time);
  double largest = 0;
  for (const Point3f& corner : std::span(corners).first(count)) {
    largest = std::max(largest, maxComponent(abs(place.point(Vec3d(corner)))));
  }
  return largest;
}

}  // namespace

/// Forgets crossings that lie behind `t`. What the ray starts or ends on stays left out: another query would
/// report it at a t that rounding decides.
void LineWalk::forgetBefore(float t) {
  Exclusions kept = fixed_;
  for (const Exclusions::Entry& e : exclusions_.entries().subspan(fixed_.entries().size())) {
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
  if (!hit.primitive->material && !hit.primitive->media.same()) return false;
  const Bounds3f& bounds = scene_.bounds();
  const float scale = std::max(maxComponent(abs(bounds.min)), maxComponent(abs(bounds.max)));
  if (hit.t() > kNearOrigin * scale) return false;
  const double size = std::max<double>(maxComponent(abs(ray_.o)), coordinatesOf(hit, ray_.time));
  return hit.t() * absDot(Vec3d(scene_.surface(hit, ray_).n), Vec3d(ray_.d)) <= kHoldsOrigin * size;
}

bool LineWalk::fetch(std::uint64_t& queries) {
  while (!ended_) {
    const std::optional<SceneHit> hit = scene_.closest(ray_, tMin_, exclusions_, queries);
    if (!hit) {
      ended_ = true;
      break;
    }
    advancePast(hit->hit);
    if (hit->primitive->isInvisible()) continue;
    if (isFromCamera_ && holdsOrigin(*hit)) continue;
    ahead_.push_back(*hit);
    return true;
  }
  return false;
}

std::size_t LineWalk::lookAhead(std::uint64_t& queries) {
  if (ahead_.empty() && !fetch(queries)) return 0;
  const float first = ahead_.front().t();
  const float last = first + kCoincident * (first + maxComponent(abs(ray_.o)));
  for (std::size_t i = 0;; ++i) {
    if (ahead_[i].primitive->material) return i + 1;
    // Looking one hit ahead costs nothing: whoever passes this boundary asks for the next hit anyway.
    if (i + 1 == ahead_.size() && !fetch(queries)) return i + 1;
    if (ahead_[i + 1].t() > last) return i + 1;
  }
}

}  // namespace pbrtmedia
