// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include "accelerators/accelerator.h"
#include "base/rng.h"
#include "base/warp.h"

namespace pbrtmedia::test {

/// Owns what TriangleBuffers borrow.
struct Mesh {
  std::vector<Point3f> positions;
  std::vector<std::array<std::uint32_t, 3>> indices;

  TriangleBuffers buffers() const { return {.positions = positions, .indices = indices}; }
  Point3f at(const RayHit& hit) const {
    const auto& c = indices[hit.id.primitive];
    const double u = hit.uv.x, v = hit.uv.y;
    return Point3f((1 - u - v) * Vec3d(positions[c[0]]) + u * Vec3d(positions[c[1]]) +
                   v * Vec3d(positions[c[2]]));
  }
  /// Unit, counter-clockwise.
  Vec3d normal(std::uint32_t i) const {
    const auto& c = indices[i];
    const Vec3d a(positions[c[0]]), b(positions[c[1]]), d(positions[c[2]]);
    return normalize(cross(b - a, d - a));
  }
  Mesh transformed(const Transform& t) const {
    Mesh m = *this;
    for (Point3f& p : m.positions) p = t.point(p);
    return m;
  }
};

/// [-1, 1]³, normals outward, 12 triangles.
inline Mesh boxMesh() {
  Mesh m;
  for (int i = 0; i < 8; ++i) {
    m.positions.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
  }
  m.indices = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
               {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

/// Unit sphere from an octahedron subdivided `levels` times; 8 * 4^levels triangles, normals outward.
inline Mesh sphereMesh(int levels) {
  Mesh m;
  m.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.indices = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(m.positions.size()));
      if (isNew) m.positions.emplace_back(normalize(Vec3d(m.positions[a]) + Vec3d(m.positions[b])));
      return it->second;
    };
    std::vector<std::array<std::uint32_t, 3>> next;
    for (const auto& [a, b, c] : m.indices) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      next.insert(next.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    m.indices = std::move(next);
  }
  return m;
}

inline Accelerator builtFrom(const Mesh& mesh, const HitFilter* filter = nullptr) {
  Accelerator a;
  a.addTriangles(mesh.buffers(), filter);
  a.build();
  return a;
}

/// The same beside so many triangles, far away, that rays are led through a tree.
inline Accelerator builtAsTreeFrom(const Mesh& mesh) {
  static const Mesh kFar = sphereMesh(3).transformed(Transform::translate({0, 0, -10000}));
  Accelerator a;
  a.addTriangles(mesh.buffers());
  a.addTriangles(kFar.buffers());
  a.build();
  return a;
}

inline Ray makeRay(Point3f o, Vector3f d, float tMax = kInfinity, float time = 0) {
  return {.o = o, .d = d, .tMax = tMax, .time = time};
}

inline Vector3f randomDirection(Rng& rng) {
  const float a = rng.uniform(), b = rng.uniform();
  return sampleUniformSphere({a, b});
}
inline Point3f randomPoint(Rng& rng, float size) {
  const float a = rng.uniform(), b = rng.uniform(), c = rng.uniform();
  return {size * (2 * a - 1), size * (2 * b - 1), size * (2 * c - 1)};
}

}  // namespace pbrtmedia::test
