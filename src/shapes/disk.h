// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/quadric.h"

namespace pbrtmedia {

/// z = height, innerradius <= distance from the axis <= radius. v is 0 at the rim, 1 at the inner radius.
/// Natural normal: +z. Scene-language reference 13.2.
class Disk final : public Quadric {
 public:
  struct Params {
    float height = 0;
    float radius = 1;       ///< > 0
    float innerradius = 0;  ///< in [0, radius)
    float phimax = 360;     ///< degrees, clamped to [0, 360]
  };
  /// Throws std::invalid_argument, naming parameter and value, when nothing of the surface would be left.
  Disk(const Params& params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "disk"; }

 private:
  Bounds3d objectBounds() const override;
  std::array<double, 3> lineEquation(Vec3d o, Vec3d d) const override;
  Vec3d project(Vec3d p) const override;
  bool contains(Vec3d p) const override;
  Point2d parameters(Vec3d p) const override;
  Vec3d normal(Vec3d p) const override;
  Derivatives derivatives(Vec3d p) const override;
  double objectArea() const override;
  Vec3d sampleObject(Point2d u) const override;

  double height_, radius_, innerRadius_, phiMax_;
};

}  // namespace pbrtmedia
