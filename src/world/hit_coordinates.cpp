// SPDX-License-Identifier: BSD-2-Clause
#include "world/hit_coordinates.h"

#include <algorithm>
#include <array>
#include <span>
#include <variant>

#include "shapes/shape.h"

namespace pbrtmedia {

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
  double largest = 0;
  const auto add = [&](Vec3d corner) { largest = std::max(largest, maxComponent(abs(corner))); };
  if (hit.placement) {
    const Transform place = hit.placement->worldFromObject(time);
    for (const Point3f& corner : std::span(corners).first(count)) add(place.point(Vec3d(corner)));
  } else {
    for (const Point3f& corner : std::span(corners).first(count)) add(Vec3d(corner));
  }
  return largest;
}

}  // namespace pbrtmedia
