// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/few_shapes.h"

namespace pbrtmedia {
namespace {

/// More are led through a tree: planes that a ray is told about, triangles, and records.
constexpr std::size_t kMostPlanes = 16, kMostTrianglesEach = 64, kMostItems = 6;
/// Of the coordinates: corners so near to a plane are in it. Rounding of corners that were meant to be.
constexpr double kInPlane = 0x1p-21;
/// Of the coordinates: rounding of what is computed from exact ones.
constexpr double kExact = 1e-12;
/// Of the coordinates, by which boxes grow: roundings of what they were computed from.
constexpr double kBoxGrowth = 0x1p-20;
/// A mesh of fewer facets is no body, and soon looked through; nor is one that is thinner, of the
/// coordinates.
constexpr std::size_t kFewestFacets = 4;
constexpr double kThinnest = 0x1p-10;
/// Sine of the angle up to which two facets are parallel.
constexpr double kParallel = 1e-12;

}  // namespace

FewShapes::Item::Triangle::Triangle(std::uint32_t number, const std::array<Vec3d, 3>& c)
    : primitive(number), corners(c) {
  const Vec3d ab = c[1] - c[0], ac = c[2] - c[0], n = pbrtmedia::cross(ab, ac);
  const double inverse = 1 / dot(n, n);
  height = Even::from(c[0], n);
  second = Even::from(c[0], pbrtmedia::cross(ac, n) * inverse);
  third = Even::from(c[0], pbrtmedia::cross(n, ab) * inverse);
}

FewShapes::Item::Item(const GeometryRecord& record) : record_(&record) {
  std::vector<Triangle> triangles;
  if (record.user) {
    const Bounds3f box = record.user->primitiveBounds(0);
    box_.expand(Vec3d(box.min));
    box_.expand(Vec3d(box.max));
  }
  for (std::uint32_t i = 0; i < record.triangles.indices.size(); ++i) {
    const auto corners = record.corners(i);
    for (const Vec3d& corner : corners) box_.expand(corner);
    const Triangle triangle(i, corners);
    if (lengthSquared(triangle.height.gradient) > 0) triangles.push_back(triangle);
  }
  size_ = std::max(maxComponent(abs(box_.min)), maxComponent(abs(box_.max)));
  const double by = kBoxGrowth * size_;
  box_.min -= Vec3d(by, by, by);
  box_.max += Vec3d(by, by, by);
  addFacets(std::move(triangles));
  if (facets_.size() >= kFewestFacets) addSlabs();
}

void FewShapes::Item::addFacets(std::vector<Triangle> triangles) {
  while (!triangles.empty()) {
    const Triangle& some = triangles.front();
    const Vec3d n = normalize(some.height.gradient);
    Facet facet{n, dot(n, some.corners[0]), triangles_.size(), 0, false, false};
    const auto isElsewhere = [&](const Triangle& t) {
      return std::ranges::any_of(t.corners,
                                 [&](Vec3d p) { return std::abs(facet.heightOf(p)) > kInPlane * size_; });
    };
    const auto rest = std::stable_partition(triangles.begin(), triangles.end(), isElsewhere);
    triangles_.insert(triangles_.end(), rest, triangles.end());
    triangles.erase(rest, triangles.end());
    facet.end = triangles_.size();
    facet.isTiled = isTiled(facet);
    facet.isExact = isExact(facet);
    facets_.push_back(facet);
  }
}

/// Known of one triangle, and of two on either side of a common edge.
bool FewShapes::Item::isTiled(const Facet& facet) const {
  if (facet.end - facet.first == 1) return true;
  if (facet.end - facet.first != 2) return false;
  const auto &a = triangles_[facet.first].corners, &b = triangles_[facet.first + 1].corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d p = a[i], q = a[(i + 1) % 3], across = pbrtmedia::cross(facet.n, q - p);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d r = b[k], s = b[(k + 1) % 3];
      const bool isCommon = (p == r && q == s) || (p == s && q == r);
      if (isCommon && dot(a[(i + 2) % 3] - p, across) * dot(b[(k + 2) % 3] - p, across) < 0) return true;
    }
  }
  return false;
}

bool FewShapes::Item::isExact(const Facet& facet) const {
  if ((facet.n.x == 0) + (facet.n.y == 0) + (facet.n.z == 0) != 2) return false;
  return std::all_of(triangles_.begin() + static_cast<std::ptrdiff_t>(facet.first), triangles_.end(),
                     [&](const Triangle& triangle) {
                       return std::ranges::all_of(triangle.corners, [&](Vec3d p) {
                         return std::abs(facet.heightOf(p)) <= kExact * size_;
                       });
                     });
}

void FewShapes::Item::addSlabs() {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::vector<Slab> slabs;
  for (std::size_t number = 0; number < facets_.size(); ++number) {
    const Facet& facet = facets_[number];
    double lowest = 0, highest = 0;
    for (const Triangle& triangle : triangles_) {
      for (const Vec3d& corner : triangle.corners) {
        lowest = std::min(lowest, facet.heightOf(corner));
        highest = std::max(highest, facet.heightOf(corner));
      }
    }
    if (std::min(-lowest, highest) > (facet.isExact ? kExact : kInPlane) * size_) return;
    if (std::max(-lowest, highest) < kThinnest * size_) return;
    const double outward = highest > -lowest ? -1 : 1;  // along n
    const auto opposite = std::ranges::find_if(slabs, [&](const Slab& slab) {
      return slab.facet[0] == kNone && slab.isExact == facet.isExact &&
             length(pbrtmedia::cross(slab.n, facet.n)) <= kParallel && dot(slab.n, facet.n) * outward < 0;
    });
    if (opposite != slabs.end()) {
      opposite->offset[0] = dot(opposite->n, triangles_[facet.first].corners[0]);
      opposite->facet[0] = number;
    } else {
      slabs.push_back(
          {outward * facet.n, {-kInfinite, outward * facet.offset}, {kNone, number}, facet.isExact});
    }
  }
  slabs_ = std::move(slabs);
}

std::unique_ptr<const FewShapes> FewShapes::of(std::span<const std::unique_ptr<GeometryRecord>> records) {
  auto few = std::make_unique<FewShapes>();
  few->items_.reserve(kMostItems);
  std::size_t planes = 0;
  for (const auto& record : records) {
    const bool isEmpty = record->user ? record->user->primitiveCount() == 0 : !record->isTriangles();
    if (record->object || (record->user && record->user->primitiveCount() > 1)) return nullptr;
    if (isEmpty) continue;
    if (record->triangles.indices.size() > kMostTrianglesEach || few->items_.size() == kMostItems)
      return nullptr;
    few->items_.emplace_back(*record);
    planes += few->items_.back().cost();
    if (planes > kMostPlanes) return nullptr;
  }
  return few;
}

}  // namespace pbrtmedia
