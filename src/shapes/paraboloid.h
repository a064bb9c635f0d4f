// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/revolved_quadric.h"

namespace pbrtmedia {

/// z = zmax (x² + y²) / radius², clipped to [zmin, zmax]. v = (z - zmin) / (zmax - zmin). Natural normal:
/// away from the axis. Scene-language reference 13.2.
class Paraboloid final : public RevolvedQuadric {
 public:
  struct Params {
    float radius = 1;          ///< at zmax; > 0
    float zmin = 0, zmax = 1;  ///< sorted; zmax > 0
    float phimax = 360;        ///< degrees, clamped to [0, 360]
  };
  /// Throws std::invalid_argument, naming parameter and value, when nothing of the surface would be left.
  Paraboloid(const Params& params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "paraboloid"; }

 private:
  static Profile profileOf(const Params& params);
  double vAt(double z) const override;
  HeightDerivatives heightDerivatives(double z) const override;
  double zMin_, zMax_;  ///< as given: zMin_ may lie below the apex
};

}  // namespace pbrtmedia
