// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/paraboloid.h"

#include "shapes/parameter_checks.h"

namespace pbrtmedia {

RevolvedQuadric::Profile Paraboloid::profileOf(const Params& params) {
  requirePositive("radius", params.radius);
  requireFinite("zmin", params.zmin);
  requireFinite("zmax", params.zmax);
  const double zMin = std::min(params.zmin, params.zmax), zMax = std::max(params.zmin, params.zmax);
  if (!(zMax > 0)) rejectParameter("zmax", "a height > 0 (the apex is at z = 0)", params.zmax);
  if (zMin == zMax) rejectParameter("zmax", "a height different from zmin", params.zmax);
  return {.c1 = sqr(static_cast<double>(params.radius)) / zMax,
          .zMin = std::max(0.0, zMin),
          .zMax = zMax,
          .phiMax = sweepAngle(params.phimax)};
}

Paraboloid::Paraboloid(const Params& params, const ShapePlacement& placement)
    : RevolvedQuadric(placement, profileOf(params)),
      zMin_(std::min(params.zmin, params.zmax)),
      zMax_(std::max(params.zmin, params.zmax)) {}

double Paraboloid::vAt(double z) const { return (z - zMin_) / (zMax_ - zMin_); }

RevolvedQuadric::HeightDerivatives Paraboloid::heightDerivatives(double) const { return {zMax_ - zMin_, 0}; }

}  // namespace pbrtmedia
