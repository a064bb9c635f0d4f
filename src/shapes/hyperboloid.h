// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/revolved_quadric.h"

namespace pbrtmedia {

/// The segment p1 p2 revolved about z, phi measured from the segment. v = (z - p1.z) / (p2.z - p1.z), with p1
/// and p2 exchanged when p2.z = 0. Natural normal: dp/du x dp/dv. Scene-language reference 13.2.
class Hyperboloid final : public RevolvedQuadric {
 public:
  struct Params {
    Point3f p1{0, 0, 0}, p2{1, 1, 1};  ///< at different heights, not both on the axis
    float phimax = 360;                ///< degrees, clamped to [0, 360]
  };
  /// Throws std::invalid_argument, naming parameter and value, when nothing of the surface would be left.
  Hyperboloid(const Params& params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "hyperboloid"; }

 private:
  static Profile profileOf(const Params& params);
  double vAt(double z) const override;
  HeightDerivatives heightDerivatives(double z) const override;
  double phase(double z) const override;
  Derivatives derivatives(Vec3d p) const override;

  Vec3d p1_, p2_;
};

}  // namespace pbrtmedia
