// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/built_parts.h"

namespace pbrtmedia {

/// Points with what they carry (`P::p`), to be found by place. Sorted along a Morton curve, with boxes around
/// every few of them, around every two of these boxes, and so on. Tree and order, in which points are found
/// too, follow from the places of the points; that of points in one cell of the curve, from theirs in
/// `points`. Immutable, thread-safe.
template <class P>
class PhotonMap {
 public:
  PhotonMap() = default;
  explicit PhotonMap(const std::vector<P>& points);

  std::size_t size() const { return points_.size(); }
  /// Calls visit(point, squared distance) for each point no farther than `radius` (>= 0) from `p`.
  template <class Visit>
  void within(Point3f p, float radius, const Visit& visit) const;

 private:
  static constexpr std::size_t kLeaf = 8;
  /// Squared distance of a box, 0 inside.
  static float squaredDistance(const Bounds3f& box, Point3f p) {
    float sum = 0;
    for (int i = 0; i < 3; ++i) sum += sqr(std::max({box.min[i] - p[i], p[i] - box.max[i], 0.0f}));
    return sum;
  }

  std::vector<P> points_;
  std::vector<std::vector<Bounds3f>> levels_;  ///< the first of leaves, the last of one box
};

/// Bits of the place of `p` in a box along each axis, interleaved.
inline std::uint64_t mortonCode(Point3f p, const Bounds3f& box) {
  constexpr int kBits = 21;
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = double{box.max[axis]} - double{box.min[axis]};
    const double share = size > 0 ? (double{p[axis]} - double{box.min[axis]}) / size : 0;
    const auto cell = static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * ((1 << kBits) - 1));
    for (int bit = 0; bit < kBits; ++bit) code |= ((cell >> bit) & 1u) << (3 * bit + axis);
  }
  return code;
}

template <class P>
PhotonMap<P>::PhotonMap(const std::vector<P>& points) {
  if (points.empty()) return;
  countBuilt(Part::PhotonMaps);
  Bounds3f all;
  for (const P& point : points) all.expand(point.p);
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(mortonCode(points[i].p, all), i);
  std::sort(order.begin(), order.end());
  points_.reserve(points.size());
  for (const auto& [code, index] : order) points_.push_back(points[index]);

  levels_.emplace_back((points_.size() + kLeaf - 1) / kLeaf);
  for (std::size_t i = 0; i < points_.size(); ++i) levels_[0][i / kLeaf].expand(points_[i].p);
  while (levels_.back().size() > 1) {
    const std::vector<Bounds3f>& below = levels_.back();
    std::vector<Bounds3f> level((below.size() + 1) / 2);
    for (std::size_t i = 0; i < below.size(); ++i) level[i / 2].expand(below[i]);
    levels_.push_back(std::move(level));
  }
}

template <class P>
template <class Visit>
void PhotonMap<P>::within(Point3f p, float radius, const Visit& visit) const {
  if (points_.empty()) return;
  const float squared = radius * radius;
  // Depth first, the lower half first: nodes still open are at most one a level.
  std::size_t level = levels_.size() - 1, node = 0;
  for (;;) {
    if (squaredDistance(levels_[level][node], p) <= squared) {
      if (level > 0) {
        --level;
        node *= 2;
        continue;
      }
      const std::size_t end = std::min((node + 1) * kLeaf, points_.size());
      for (std::size_t i = node * kLeaf; i < end; ++i) {
        const float distance2 = lengthSquared(points_[i].p - p);
        if (distance2 <= squared) visit(points_[i], distance2);
      }
    }
    // The next node that is not below this one.
    ++node;
    while (node % 2 == 0 && level + 1 < levels_.size()) {
      node /= 2;
      ++level;
    }
    if (level + 1 == levels_.size() || node >= levels_[level].size()) return;
  }
}

}  // namespace pbrtmedia
