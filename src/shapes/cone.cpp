// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/cone.h"

#include "shapes/parameter_checks.h"

namespace pbrtmedia {

RevolvedQuadric::Profile Cone::profileOf(const Params& params) {
  requirePositive("radius", params.radius);
  requirePositive("height", params.height);
  const double r = params.radius, h = params.height;
  // radius² (1 - z / height)²
  return {.c0 = r * r,
          .c1 = -2 * r * r / h,
          .c2 = sqr(r / h),
          .zMin = 0,
          .zMax = h,
          .phiMax = sweepAngle(params.phimax)};
}

Cone::Cone(const Params& params, const ShapePlacement& placement)
    : RevolvedQuadric(placement, profileOf(params)) {}

double Cone::vAt(double z) const { return z / profile().zMax; }

RevolvedQuadric::HeightDerivatives Cone::heightDerivatives(double) const { return {profile().zMax, 0}; }

}  // namespace pbrtmedia
