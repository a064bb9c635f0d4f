// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/cylinder.h"

#include "shapes/parameter_checks.h"

namespace pbrtmedia {

RevolvedQuadric::Profile Cylinder::profileOf(const Params& params) {
  requirePositive("radius", params.radius);
  requireFinite("zmin", params.zmin);
  requireFinite("zmax", params.zmax);
  if (params.zmin == params.zmax) rejectParameter("zmax", "a height different from zmin", params.zmax);
  return {.c0 = sqr(static_cast<double>(params.radius)),
          .zMin = std::min(params.zmin, params.zmax),
          .zMax = std::max(params.zmin, params.zmax),
          .phiMax = sweepAngle(params.phimax)};
}

Cylinder::Cylinder(const Params& params, const ShapePlacement& placement)
    : RevolvedQuadric(placement, profileOf(params)) {}

double Cylinder::vAt(double z) const { return (z - profile().zMin) / (profile().zMax - profile().zMin); }

RevolvedQuadric::HeightDerivatives Cylinder::heightDerivatives(double) const {
  return {profile().zMax - profile().zMin, 0};
}

}  // namespace pbrtmedia
