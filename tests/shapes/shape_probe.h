// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "accelerators/accelerator.h"
#include "base/rng.h"
#include "base/warp.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "shapes/hyperboloid.h"
#include "shapes/paraboloid.h"
#include "shapes/sphere.h"
#include "shapes/triangle_mesh.h"

namespace pbrtmedia::test {

inline Ray makeRay(Point3f o, Vector3f d, float tMax = kInfinity) {
  return {.o = o, .d = d, .tMax = tMax, .time = 0};
}

inline Vector3f randomDirection(Rng& rng) {
  const float a = rng.uniform(), b = rng.uniform();
  return sampleUniformSphere({a, b});
}

/// One shape in an accelerator of its own.
class Probe {
 public:
  explicit Probe(const Shape& shape) : shape_(shape) {
    const Shape::Geometry g = shape.geometry();
    if (const auto* triangles = std::get_if<TriangleBuffers>(&g)) {
      accelerator_.addTriangles(*triangles);
    } else {
      accelerator_.addUser(*std::get<const UserGeometry*>(g));
    }
    accelerator_.build();
  }
  const Accelerator& accelerator() const { return accelerator_; }
  std::optional<RayHit> hit(const Ray& ray, float tMin = 0, const Exclusions& exclusions = {}) const {
    return accelerator_.intersect(ray, tMin, exclusions);
  }
  std::optional<SurfaceInteraction> at(const Ray& ray) const {
    const auto h = hit(ray);
    if (!h) return std::nullopt;
    return shape_.interaction(*h, ray);
  }
  /// All hits along the ray, by crossing one after the other.
  std::vector<SurfaceInteraction> all(const Ray& ray) const {
    std::vector<SurfaceInteraction> result;
    Exclusions exclusions;
    float t = 0;
    while (const auto h = hit(ray, t, exclusions)) {
      result.push_back(shape_.interaction(*h, ray));
      t = h->t;
      exclusions.dropBefore(t);
      if (!exclusions.add(h->id, t)) break;
    }
    return result;
  }

 private:
  const Shape& shape_;
  Accelerator accelerator_;
};

/// A kind of quadric with its object-space parametrisation written down a second time, from the reference.
struct QuadricCase {
  std::string name;
  std::function<std::unique_ptr<Shape>(const ShapePlacement&)> make;
  std::function<Vec3d(double u, double v)> point;
};

inline Vec3d polar(double r, double phi, double z) { return {r * std::cos(phi), r * std::sin(phi), z}; }

inline std::vector<QuadricCase> quadricCases() {
  static constexpr double pi = std::numbers::pi;
  std::vector<QuadricCase> cases;
  cases.push_back(
      {"sphere",
       [](const ShapePlacement& p) { return std::make_unique<Sphere>(Sphere::Params{.radius = 1.5f}, p); },
       [](double u, double v) {
         const double theta = pi - v * pi;
         return polar(1.5 * std::sin(theta), 2 * pi * u, 1.5 * std::cos(theta));
       }});
  cases.push_back({"clipped sphere",
                   [](const ShapePlacement& p) {
                     return std::make_unique<Sphere>(
                         Sphere::Params{.radius = 1, .zmin = 0.75f, .zmax = -0.5f, .phimax = 200}, p);
                   },
                   [](double u, double v) {
                     const double theta = lerp(v, std::acos(-0.5), std::acos(0.75));
                     return polar(std::sin(theta), u * radians(200.0), std::cos(theta));
                   }});
  cases.push_back({"cylinder",
                   [](const ShapePlacement& p) {
                     return std::make_unique<Cylinder>(
                         Cylinder::Params{.radius = 0.5f, .zmin = -1, .zmax = 2, .phimax = 270}, p);
                   },
                   [](double u, double v) { return polar(0.5, u * radians(270.0), -1 + 3 * v); }});
  cases.push_back({"disk",
                   [](const ShapePlacement& p) {
                     return std::make_unique<Disk>(
                         Disk::Params{.height = 0.5f, .radius = 1.5f, .innerradius = 0.5f, .phimax = 300}, p);
                   },
                   [](double u, double v) { return polar(1.5 - v, u * radians(300.0), 0.5); }});
  cases.push_back({"cone",
                   [](const ShapePlacement& p) {
                     return std::make_unique<Cone>(Cone::Params{.radius = 1.25f, .height = 2, .phimax = 330},
                                                   p);
                   },
                   [](double u, double v) { return polar(1.25 * (1 - v), u * radians(330.0), 2 * v); }});
  cases.push_back({"paraboloid",
                   [](const ShapePlacement& p) {
                     return std::make_unique<Paraboloid>(
                         Paraboloid::Params{.radius = 1, .zmin = 0.125f, .zmax = 2, .phimax = 360}, p);
                   },
                   [](double u, double v) {
                     const double z = lerp(v, 0.125, 2.0);
                     return polar(std::sqrt(z / 2), 2 * pi * u, z);
                   }});
  cases.push_back({"hyperboloid",
                   [](const ShapePlacement& p) {
                     return std::make_unique<Hyperboloid>(
                         Hyperboloid::Params{.p1 = {1, 0.5f, -1}, .p2 = {-0.5f, 1, 1}, .phimax = 290}, p);
                   },
                   [](double u, double v) {
                     const double x = 1 - 1.5 * v, y = 0.5 + 0.5 * v, a = u * radians(290.0);
                     return Vec3d(x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a),
                                  -1 + 2 * v);
                   }});
  cases.push_back({"falling hyperboloid",  // p1 and p2 exchanged, so v runs downward
                   [](const ShapePlacement& p) {
                     return std::make_unique<Hyperboloid>(
                         Hyperboloid::Params{.p1 = {0.5f, 0.75f, -1}, .p2 = {0.5f, 0, 0}, .phimax = 360}, p);
                   },
                   [](double u, double v) {
                     const double x = 0.5, y = 0.75 * v, a = u * 2 * pi;
                     return Vec3d(x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a), -v);
                   }});
  return cases;
}

struct PlacementCase {
  std::string name;
  ShapePlacement placement;
};

/// Plain, turned around, mirrored, both, scaled evenly and unevenly.
inline std::vector<PlacementCase> placements() {
  const Transform moved = Transform::translate({0.5, -2, 1}) * Transform::rotate(40, {1, 2, -0.5});
  return {{"plain", {Transform(), false}},
          {"reversed", {moved, true}},
          {"mirrored", {moved * Transform::scale(-1, 1, 1), false}},
          {"mirrored and reversed", {moved * Transform::scale(1, 1, -1), true}},
          {"scaled", {moved * Transform::scale(2.5, 2.5, 2.5), false}},
          {"stretched", {moved * Transform::scale(0.5, 2, 1.5), false}},
          {"stretched and mirrored", {moved * Transform::scale(1.5, -0.5, 0.75), true}}};
}

/// A grid over (u, v) in world space.
inline TriangleMesh::Params tessellate(const QuadricCase& shape, const Transform& worldFromObject, int n) {
  TriangleMesh::Params mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      mesh.P.emplace_back(worldFromObject.point(shape.point(double(i) / n, double(j) / n)));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

}  // namespace pbrtmedia::test
