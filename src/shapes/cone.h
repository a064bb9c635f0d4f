// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/revolved_quadric.h"

namespace pbrtmedia {

/// Base circle of `radius` at z = 0, apex at z = height. v = z / height. Natural normal: outward.
/// Scene-language reference 13.2.
class Cone final : public RevolvedQuadric {
 public:
  struct Params {
    float radius = 1, height = 1;  ///< > 0
    float phimax = 360;            ///< degrees, clamped to [0, 360]
  };
  /// Throws std::invalid_argument, naming parameter and value, when nothing of the surface would be left.
  Cone(const Params& params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "cone"; }

 private:
  static Profile profileOf(const Params& params);
  double vAt(double z) const override;
  HeightDerivatives heightDerivatives(double z) const override;
};

}  // namespace pbrtmedia
