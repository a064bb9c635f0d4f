// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/boundary_closure.h"

#include <array>
#include <map>

namespace pbrtmedia {
namespace {

/// Three times the enclosed volume by the divergence theorem, negative when the normals face inward; up to
/// the error of a few samples on curved shapes, which does not touch its sign on convex ones.
double signedVolume(const Shape& shape) {
  const std::uint32_t count = shape.primitiveCount();
  const std::uint32_t samples = count > 1 ? 1 : 16;
  const Point3f centre = shape.bounds().centre();
  double sum = 0;
  for (std::uint32_t primitive = 0; primitive < count; ++primitive) {
    for (std::uint32_t i = 0; i < samples; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
      const ShapeSample s = shape.sample(primitive, Point2f(u, i % 2 == 0 ? 0.25f : 0.75f));
      sum += shape.area(primitive) / samples * dot(Vec3d(s.p) - Vec3d(centre), Vec3d(s.n));
    }
  }
  return sum;
}

using EdgeKey = std::array<float, 6>;
EdgeKey edgeKey(Point3f a, Point3f b) {
  const std::array<float, 3> pa{a.x, a.y, a.z}, pb{b.x, b.y, b.z};
  const auto& lo = pa < pb ? pa : pb;
  const auto& hi = pa < pb ? pb : pa;
  return {lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]};
}

/// Meshes that may close one another.
struct Patchwork {
  std::map<EdgeKey, std::uint32_t> edges;  ///< how many triangles meet there
  double volume = 0;
  bool hasCurved = false;

  void add(const Shape& shape) {
    const Shape::Geometry geometry = shape.geometry();
    const auto* triangles = std::get_if<TriangleBuffers>(&geometry);
    if (!triangles) {
      hasCurved = true;
      return;
    }
    for (const auto& corners : triangles->indices) {
      for (std::size_t i = 0; i < 3; ++i) {
        ++edges[edgeKey(triangles->positions[corners[i]], triangles->positions[corners[(i + 1) % 3]])];
      }
    }
    for (std::uint32_t i = 0; i < shape.primitiveCount(); ++i) {
      const ShapeSample s = shape.sample(i, Point2f(0.25f, 0.25f));
      volume += shape.area(i) * dot(Vec3d(s.p), Vec3d(s.n));
    }
  }
  bool isClosed() const {
    if (hasCurved) return false;
    for (const auto& [key, count] : edges) {
      if (count % 2 != 0) return false;
    }
    return volume > 0;
  }
};

}  // namespace

std::unordered_set<const Medium*> findConfinedMedia(const Scene& scene) {
  std::unordered_set<const Medium*> confined, free;
  for (const auto& group : scene.primitiveGroups()) {
    std::map<std::pair<const Medium*, const Medium*>, Patchwork> patchworks;
    for (const Primitive* p : group) {
      if (p->media.same()) continue;
      if (p->media.inside) confined.insert(p->media.inside);
      free.insert(p->media.outside);
      if (!p->shape->isClosed()) {
        patchworks[{p->media.inside, p->media.outside}].add(*p->shape);
      } else if (!(signedVolume(*p->shape) > 0)) {
        free.insert(p->media.inside);
      }
    }
    for (const auto& [media, patchwork] : patchworks) {
      if (!patchwork.isClosed()) free.insert(media.first);
    }
  }
  for (const Medium* m : free) confined.erase(m);
  return confined;
}

}  // namespace pbrtmedia
