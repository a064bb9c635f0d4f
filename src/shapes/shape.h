// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "accelerators/accelerator.h"
#include "base/bounds.h"
#include "base/ray.h"
#include "base/transform.h"
#include "shapes/surface_interaction.h"

namespace pbrtmedia {

/// A point sampled on a shape.
struct ShapeSample {
  Point3f p;
  Normal3f n;     ///< unit, oriented as at hits
  float pdf = 0;  ///< area measure (1/length²) or solid angle (1/sr), as the function says; 0: unusable
};

/// Geometry only: no material, no medium, no light. World space = the space of the CTM at the Shape directive
/// (instances are applied outside). A mesh holds many primitives, every other shape one. Immutable,
/// thread-safe.
class Shape {
 public:
  virtual ~Shape() = default;
  virtual std::string_view typeName() const = 0;
  virtual std::uint32_t primitiveCount() const { return 1; }
  virtual Bounds3f bounds() const = 0;
  /// True when the surface has no border (so it separates an inside from an outside).
  virtual bool isClosed() const = 0;
  /// What the accelerator intersects.
  using Geometry = std::variant<TriangleBuffers, const UserGeometry*>;
  virtual Geometry geometry() const = 0;
  /// Local geometry at a reported hit. `ray` gives wo and time; its t is hit.t.
  virtual SurfaceInteraction interaction(const RayHit& hit, const Ray& ray) const = 0;
  /// (u, v) only, for alpha tests.
  virtual Point2f uvAt(const RayHit& hit) const = 0;

  /// Whether PBRT-v3 samples this shape, when it is a light, with normals opposite to those of hits, so that
  /// light samples find the side emitting that is seen dark (scene-language reference 13.1, 13.3).
  virtual bool isSampledFromBehind() const { return false; }
  /// Area of the surface that PBRT-v3 samples in place of this shape when it is a light: that of the shape
  /// before its transformation, and of a whole sphere for a part of one. World-space area where it is right.
  virtual double areaSampledByPbrt(std::uint32_t primitive) const { return area(primitive); }

  /// World-space area of one primitive.
  virtual double area(std::uint32_t primitive) const = 0;
  /// Uniform by area; pdf in area measure.
  virtual ShapeSample sample(std::uint32_t primitive, Point2f u) const = 0;
  /// Density of that, 1/length², at a point of the surface where the unit normal is `n`, either way.
  virtual double areaDensity(std::uint32_t primitive, Normal3f n) const;
  /// Toward `reference`, pdf in solid angle there. Default: by area, converted.
  virtual ShapeSample sample(std::uint32_t primitive, Point3f reference, Point2f u) const;
  /// Solid-angle density with which `sample(primitive, reference, .)` finds the surface point (p, n) that was
  /// hit along unit `wi` from `reference`.
  virtual float pdf(std::uint32_t primitive, Point3f reference, Vector3f wi, Point3f p, Normal3f n) const;
};

/// Placement facts every shape is built with.
struct ShapePlacement {
  Transform worldFromObject;
  bool reverseOrientation = false;
  /// ReverseOrientation XOR mirrored CTM.
  bool flipsNormal() const { return reverseOrientation != worldFromObject.swapsHandedness(); }
};

}  // namespace pbrtmedia
