// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/revolved_quadric.h"

namespace pbrtmedia {

/// x² + y² + z² = radius², zmin <= z <= zmax, phi <= phimax. v runs from 0 at zmin to 1 at zmax, linear in
/// the polar angle. Natural normal: outward. Scene-language reference 13.2.
class Sphere final : public RevolvedQuadric {
 public:
  struct Params {
    float radius = 1;                           ///< > 0
    std::optional<float> zmin = {}, zmax = {};  ///< default -radius, radius; sorted and clamped to ±radius
    float phimax = 360;                         ///< degrees, clamped to [0, 360]
  };
  /// Throws std::invalid_argument, naming parameter and value, when nothing of the surface would be left.
  Sphere(const Params& params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "sphere"; }
  bool isClosed() const override { return isComplete_; }

  double areaSampledByPbrt(std::uint32_t primitive) const override;
  using Quadric::sample;
  /// A complete sphere seen from outside: uniform in the cone of directions that meets it (in object space,
  /// so ellipsoids too); otherwise by area.
  ShapeSample sample(std::uint32_t primitive, Point3f reference, Point2f u) const override;
  float pdf(std::uint32_t primitive, Point3f reference, Vector3f wi, Point3f p, Normal3f n) const override;

 private:
  static Profile profileOf(const Params& params);
  double vAt(double z) const override;
  HeightDerivatives heightDerivatives(double z) const override;
  Derivatives derivatives(Vec3d p) const override;
  /// 1 - cos of the half-angle under which the complete sphere appears from an object-space point; nothing
  /// when it is clipped, or the point inside or too near for its rounded coordinates to tell.
  std::optional<double> coneFrom(Vec3d reference, Point3f referenceWorld) const;
  /// Solid-angle density in the world of a density on object-space directions, per unit direction `d` there.
  double worldDensity(double objectDensity, Vec3d d) const;

  double radius_, thetaMin_, thetaMax_;
  bool isComplete_;
};

}  // namespace pbrtmedia
