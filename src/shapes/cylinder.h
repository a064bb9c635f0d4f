// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/revolved_quadric.h"

namespace pbrtmedia {

/// x² + y² = radius², zmin <= z <= zmax. v = (z - zmin) / (zmax - zmin). Natural normal: outward.
/// Scene-language reference 13.2.
class Cylinder final : public RevolvedQuadric {
 public:
  struct Params {
    float radius = 1;           ///< > 0
    float zmin = -1, zmax = 1;  ///< sorted
    float phimax = 360;         ///< degrees, clamped to [0, 360]
  };
  /// Throws std::invalid_argument, naming parameter and value, when nothing of the surface would be left.
  Cylinder(const Params& params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "cylinder"; }

 private:
  static Profile profileOf(const Params& params);
  double vAt(double z) const override;
  HeightDerivatives heightDerivatives(double z) const override;
};

}  // namespace pbrtmedia
