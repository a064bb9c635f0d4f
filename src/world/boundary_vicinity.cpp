// SPDX-License-Identifier: BSD-2-Clause
#include "world/boundary_vicinity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shapes/shape.h"
#include "world/scene.h"

namespace pbrtmedia {
namespace {

/// More boundaries than this are not asked one by one, nor planes of meshes of more triangles.
constexpr std::size_t kMostItems = 64, kMostTriangles = 32;
/// Share of the coordinates; some times what LineWalk takes for coincident.
constexpr double kVicinity = 0x1p-17;

/// The radius, if samples of the shape say that it is a complete sphere around the middle of its box; else 0.
double sphereRadius(const Shape& shape) {
  const Bounds3f box = shape.bounds();
  const double radius = 0.5 * double{box.max.x - box.min.x};
  for (int i = 0; i < 16; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / 16;
    const Vec3d p(shape.sample(0, Point2f(u, 5 * u - std::floor(5 * u))).p);
    if (!(std::abs(length(p - Vec3d(box.centre())) - radius) <= 1e-5 * radius)) return 0;
  }
  return radius;
}

double largest(const Bounds3f& box) {
  return double{std::max(maxComponent(abs(box.min)), maxComponent(abs(box.max)))};
}

}  // namespace

bool BoundaryVicinity::Item::mayHold(Point3f p) const {
  const double tolerance = kVicinity * std::max(extent, double{maxComponent(abs(p))});
  for (std::size_t i = 0; i < 3; ++i) {
    if (p[i] < box.min[i] - tolerance || p[i] > box.max[i] + tolerance) return false;
  }
  if (radius > 0)
    return std::abs(length(Vec3d(p) - Vec3d(box.centre())) - radius) <= tolerance + 1e-5 * radius;
  return planes.empty() || std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
           return std::abs(dot(plane.n, Vec3d(p)) - plane.offset) <= tolerance;
         });
}

BoundaryVicinity::BoundaryVicinity(const std::vector<std::vector<const Primitive*>>& groups,
                                   const std::deque<Placement>& placements) {
  auto boundaries = groups;
  for (auto& group : boundaries) std::erase_if(group, [](const Primitive* p) { return p->media.same(); });
  for (const Primitive* p : boundaries[0]) add(*p, nullptr);
  for (const Placement& placement : placements) {
    if (isUnknown_) break;
    for (const Primitive* p : boundaries[1 + placement.object()]) add(*p, &placement);
  }
}

void BoundaryVicinity::add(const Primitive& boundary, const Placement* placement) {
  isUnknown_ = isUnknown_ || items_.size() == kMostItems;
  if (isUnknown_) return;
  Item item{&boundary, placement, {}};
  item.box = boundary.shape->bounds();
  item.extent = largest(item.box);
  const bool isMoving = placement && placement->isAnimated();
  Transform worldFromObject;
  if (placement) {
    worldFromObject = placement->worldFromObject(0);
    item.box = placement->worldBounds(item.box);
    item.extent = std::max(item.extent, largest(item.box));
    item.extent = std::max(item.extent, maxComponent(abs(worldFromObject.point(Vec3d{}))));
  }
  const Shape::Geometry geometry = boundary.shape->geometry();
  const auto* const triangles = std::get_if<TriangleBuffers>(&geometry);
  if (!triangles && !placement) item.radius = sphereRadius(*boundary.shape);
  if (triangles && !isMoving && triangles->indices.size() <= kMostTriangles) {
    for (const auto& corner : triangles->indices) {
      std::array<Vec3d, 3> p;
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = worldFromObject.point(Vec3d(triangles->positions[corner[i]]));
      const Vec3d n = cross(p[1] - p[0], p[2] - p[0]);
      if (!(lengthSquared(n) > 0)) continue;
      const Plane plane{normalize(n), dot(normalize(n), p[0])};
      const auto isSame = [&](const Plane& o) { return o.n == plane.n && o.offset == plane.offset; };
      if (std::none_of(item.planes.begin(), item.planes.end(), isSame)) item.planes.push_back(plane);
    }
    if (item.planes.empty()) return;  // no surface
  }
  // Twice the tolerance at its extent: the tolerance is more only at points that much farther away.
  const auto room = static_cast<float>(2 * kVicinity * item.extent) + std::numeric_limits<float>::min();
  for (std::size_t i = 0; i < 3; ++i) {
    item.reach.min[i] = std::nextafter(item.box.min[i] - room, -kInfinity);
    item.reach.max[i] = std::nextafter(item.box.max[i] + room, kInfinity);
  }
  items_.push_back(std::move(item));
}

}  // namespace pbrtmedia
