// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <optional>
#include <span>

#include "shapes/shape.h"

namespace pbrtmedia {

/// What sphere, cylinder, disk, cone, paraboloid and hyperboloid share: a surface given by an equation of
/// degree two (or one), possibly clipped, open (no caps). Rays come in world space and are solved in object
/// space, in double; t is the same in both.
///
/// Orientation (scene-language reference 13.1): the object-space normal dp/du x dp/dv, negated by
/// ReverseOrientation XOR mirrored CTM, carried to world by the inverse transpose. Sampled normals agree with
/// those of hits; PBRT-v3 leaves out the mirror there, which `isSampledFromBehind` tells.
///
/// Sampling covers exactly the clipped surface, uniformly by *object-space* area; the pdf is the exact world
/// density, so light and area are right under any CTM. (It is uniform in world space for rotations,
/// translations and uniform scales.)
class Quadric : public Shape, public UserGeometry {
 public:
  Bounds3f bounds() const final;
  bool isClosed() const override { return false; }
  std::uint32_t primitiveCount() const final { return 1; }
  Bounds3f primitiveBounds(std::uint32_t) const final { return bounds(); }
  Geometry geometry() const final { return static_cast<const UserGeometry*>(this); }
  std::optional<Root> intersect(std::uint32_t primitive, const Ray& ray, double tMin, double tMax,
                                std::span<const float> excludedT) const final;
  SurfaceInteraction interaction(const RayHit& hit, const Ray& ray) const final;
  Point2f uvAt(const RayHit& hit) const final { return hit.uv; }

  /// Sampled normals leave out the mirror in PBRT-v3.
  bool isSampledFromBehind() const final { return worldFromObject_.swapsHandedness(); }
  double areaSampledByPbrt(std::uint32_t primitive) const override;

  /// Exact for uniform scales; otherwise by quadrature (relative error below 1e-5) on every call.
  double area(std::uint32_t primitive) const final;
  using Shape::sample;
  ShapeSample sample(std::uint32_t primitive, Point2f u) const final;
  double areaDensity(std::uint32_t primitive, Normal3f n) const final;
  float pdf(std::uint32_t primitive, Point3f reference, Vector3f wi, Point3f p, Normal3f n) const override;

 protected:
  explicit Quadric(const ShapePlacement& placement);

  /// First and second derivatives of the surface point by (u, v), object space.
  struct Derivatives {
    Vec3d dpdu, dpdv, d2pduu, d2pduv, d2pdvv;
  };

  // The surface, in object space.

  /// Box around the clipped surface.
  virtual Bounds3d objectBounds() const = 0;
  /// Coefficients of a t² + b t + c = 0 for the line o + t d.
  virtual std::array<double, 3> lineEquation(Vec3d o, Vec3d d) const = 0;
  /// Moves a point that is on the surface up to rounding onto it (to double precision).
  virtual Vec3d project(Vec3d p) const = 0;
  /// Whether a point of the unclipped surface belongs to the shape.
  virtual bool contains(Vec3d p) const = 0;
  /// (u, v) of a surface point, in [0, 1]² up to rounding.
  virtual Point2d parameters(Vec3d p) const = 0;
  /// Unit, along dp/du x dp/dv where that is not zero.
  virtual Vec3d normal(Vec3d p) const = 0;
  /// Unit, across the surface, either way. Another than `normal` where the derivatives are not quite the
  /// surface's.
  virtual Vec3d surfaceNormal(Vec3d p) const { return normal(p); }
  /// Whether a ray that starts on the surface at `o` (up to rounding) along `d` meets it again right there,
  /// as the side that `normal` says it is on then is not the one it goes to.
  virtual bool stopsAtStart(Vec3d o, Vec3d d) const {
    (void)o, (void)d;
    return false;
  }
  /// Finite everywhere and with dp/du, dp/dv not zero (at poles a nearby tangent is taken).
  virtual Derivatives derivatives(Vec3d p) const = 0;
  virtual double objectArea() const = 0;
  /// Uniform by object-space area.
  virtual Vec3d sampleObject(Point2d u) const = 0;

  const Transform& worldFromObject() const { return worldFromObject_; }
  Vec3d objectPoint(Vec3d world) const { return objectFromWorld_.point(world); }
  Vec3d objectVector(Vec3d world) const { return objectFromWorld_.vector(world); }
  /// |det| of the linear part of the placement.
  double volumeScale() const { return volumeScale_; }
  /// Size of object-space coordinates per world coordinate (Frobenius norm of the inverse's linear part).
  double inverseScale() const { return inverseScale_; }
  /// World point, oriented unit normal and area density of `sample` at a surface point.
  ShapeSample sampleAt(Vec3d pObject) const;

 private:
  struct ObjectRay {
    Vec3d o, d;
    double shift;  ///< t of `o` on the world ray: near the shape, so that far origins lose no digits
  };
  ObjectRay objectRay(const Ray& ray) const;
  Vec3d nearestPoint(const RayHit& hit, const Ray& ray) const;
  /// World area per object area where the unit object normal is n.
  double areaScale(Vec3d nObject) const;

  Transform worldFromObject_, objectFromWorld_;
  bool flips_;
  bool isSimilarity_;
  double volumeScale_, inverseScale_;
};

}  // namespace pbrtmedia
