// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/revolved_quadric.h"

namespace pbrtmedia {

/// The segment p1 p2 revolved about z, phi measured from the segment. v = (z - p1.z) / (p2.z - p1.z), with p1
/// and p2 exchanged when p2.z = 0. Natural normal: dp/du x dp/dv. Scene-language reference 13.2.
///
/// That surface only if its waist is at z = 0. Else, as in PBRT-v3: the squared radius is the polynomial
/// A + B z² that is right at p2 and at p1 + 2 (p2 - p1) (or two lengths further, where that says nothing),
/// clipped to the heights of p1 and p2; normals and derivatives are still those of the revolved segment. Rays
/// that start on the side of such a normal and go through the surface are stopped by it, as there.
class Hyperboloid final : public RevolvedQuadric {
 public:
  struct Params {
    Point3f p1{0, 0, 0}, p2{1, 1, 1};  ///< at different heights, not both on the axis
    float phimax = 360;                ///< degrees, clamped to [0, 360]
  };
  /// Throws std::invalid_argument, naming parameter and value, when nothing of the surface would be left.
  Hyperboloid(const Params& params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "hyperboloid"; }
  /// PBRT-v3's surface has no part between the heights of p1 and p2. For parameters that are good otherwise.
  static bool isEmpty(const Params& params);
  /// Whether the segment sweeps another surface, and the distance from the axis of either at p1.
  struct Waist {
    bool isElsewhere;
    double radius, sweptRadius;
  };
  static Waist waist(const Params& params);

  using Quadric::sample;
  ShapeSample sample(std::uint32_t primitive, Point3f reference, Point2f u) const override;
  float pdf(std::uint32_t primitive, Point3f reference, Vector3f wi, Point3f p, Normal3f n) const override;

 private:
  static Profile profileOf(const Params& params);
  double vAt(double z) const override;
  HeightDerivatives heightDerivatives(double z) const override;
  double phase(double z) const override;
  Vec3d normal(Vec3d p) const override;
  bool stopsAtStart(Vec3d o, Vec3d d) const override;
  Derivatives derivatives(Vec3d p) const override;
  float solidAngleDensity(Point3f reference, Vec3d pObject) const;

  Vec3d p1_, p2_;
  bool isSwept_;  ///< the surface is that of the segment
};

}  // namespace pbrtmedia
