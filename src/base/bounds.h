// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/math.h"
#include "base/vec.h"

namespace pbrtmedia {

/// Axis-aligned box. Default-constructed: empty (min > max), the neutral element of `expand`.
template <class T>
struct Bounds3 {
  Vec3<T> min{std::numeric_limits<T>::max(), std::numeric_limits<T>::max(), std::numeric_limits<T>::max()};
  Vec3<T> max{std::numeric_limits<T>::lowest(), std::numeric_limits<T>::lowest(),
              std::numeric_limits<T>::lowest()};

  constexpr bool operator==(const Bounds3&) const = default;
  constexpr bool isEmpty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  constexpr void expand(Vec3<T> p) {
    min = pbrtmedia::min(min, p);
    max = pbrtmedia::max(max, p);
  }
  constexpr void expand(const Bounds3& b) {
    min = pbrtmedia::min(min, b.min);
    max = pbrtmedia::max(max, b.max);
  }
  constexpr Vec3<T> diagonal() const { return max - min; }
  constexpr Vec3<T> centre() const { return min * T(0.5) + max * T(0.5); }
  constexpr bool contains(Vec3<T> p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
  }
  constexpr Vec3<T> corner(int i) const {
    return {(i & 1) ? max.x : min.x, (i & 2) ? max.y : min.y, (i & 4) ? max.z : min.z};
  }
};
using Bounds3f = Bounds3<float>;
using Bounds3d = Bounds3<double>;

/// Half-open pixel rectangle [min, max).
struct Bounds2i {
  Point2i min{0, 0}, max{0, 0};
  constexpr bool operator==(const Bounds2i&) const = default;
  constexpr int width() const { return max.x > min.x ? max.x - min.x : 0; }
  constexpr int height() const { return max.y > min.y ? max.y - min.y : 0; }
  constexpr std::int64_t area() const { return std::int64_t{width()} * height(); }
  constexpr bool contains(Point2i p) const {
    return p.x >= min.x && p.x < max.x && p.y >= min.y && p.y < max.y;
  }
  friend constexpr Bounds2i intersect(Bounds2i a, Bounds2i b) {
    return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
            {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
  }
};

/// The part [tMin, tMax] of a line inside a box.
template <class T>
struct Span {
  T tMin, tMax;
};

/// Clips the line o + t d, t in [tMin, tMax], to the box (slab test). A zero direction component is handled
/// by inclusion, so a ray lying in a face belongs to the box and 0/0 never forms. Nothing when they miss or
/// the box is empty.
template <class T>
std::optional<Span<T>> clipToBox(const Bounds3<T>& box, Vec3<T> o, Vec3<T> d, T tMin, T tMax) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (d[i] == T(0)) {
      if (o[i] < box.min[i] || o[i] > box.max[i]) return std::nullopt;
      continue;
    }
    const T inv = T(1) / d[i];
    const T near = ((d[i] > 0 ? box.min[i] : box.max[i]) - o[i]) * inv;
    const T far = ((d[i] > 0 ? box.max[i] : box.min[i]) - o[i]) * inv;
    if (near > tMin) tMin = near;
    if (far < tMax) tMax = far;
    if (!(tMin <= tMax)) return std::nullopt;
  }
  return Span<T>{tMin, tMax};
}

}  // namespace pbrtmedia
