// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/hyperboloid.h"

#include <array>

#include "shapes/parameter_checks.h"

namespace pbrtmedia {
namespace {

std::array<Vec3d, 2> orderedEnds(const Hyperboloid::Params& params) {
  const Vec3d a(params.p1), b(params.p2);
  if (b.z == 0) return {b, a};
  return {a, b};
}

}  // namespace

RevolvedQuadric::Profile Hyperboloid::profileOf(const Params& params) {
  if (!isFinite(params.p1)) rejectParameter("p1", "finite numbers", params.p1);
  if (!isFinite(params.p2)) rejectParameter("p2", "finite numbers", params.p2);
  if (params.p1.z == params.p2.z) rejectParameter("p2", "another height z than that of p1", params.p2);
  const auto [p1, p2] = orderedEnds(params);
  if (p1.x == 0 && p1.y == 0 && p2.x == 0 && p2.y == 0) {
    rejectParameter("p2", "p1 and p2 not both on the z axis", params.p2);
  }
  // The squared distance from the axis along the segment, with v = (z - p1.z) / (p2.z - p1.z).
  const double dz = p2.z - p1.z, dx = (p2.x - p1.x) / dz, dy = (p2.y - p1.y) / dz;
  const double x0 = p1.x - dx * p1.z, y0 = p1.y - dy * p1.z;  // the line at z = 0
  return {.c0 = x0 * x0 + y0 * y0,
          .c1 = 2 * (x0 * dx + y0 * dy),
          .c2 = dx * dx + dy * dy,
          .zMin = std::min(p1.z, p2.z),
          .zMax = std::max(p1.z, p2.z),
          .phiMax = sweepAngle(params.phimax),
          .normalSign = dz > 0 ? 1.0 : -1.0};
}

Hyperboloid::Hyperboloid(const Params& params, const ShapePlacement& placement)
    : RevolvedQuadric(placement, profileOf(params)),
      p1_(orderedEnds(params)[0]),
      p2_(orderedEnds(params)[1]) {}

double Hyperboloid::vAt(double z) const { return (z - p1_.z) / (p2_.z - p1_.z); }

RevolvedQuadric::HeightDerivatives Hyperboloid::heightDerivatives(double) const { return {p2_.z - p1_.z, 0}; }

double Hyperboloid::phase(double z) const {
  const Vec3d p = p1_ + vAt(z) * (p2_ - p1_);
  return std::atan2(p.y, p.x);
}

Quadric::Derivatives Hyperboloid::derivatives(Vec3d p) const {
  const double phi = profile().phiMax, angle = azimuth(p);
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const Vec3d along = p2_ - p1_;
  const Vec3d dpdv{cosine * along.x - sine * along.y, sine * along.x + cosine * along.y, along.z};
  // On the axis the tangent of a small circle around it.
  const double distance = std::hypot(p.x, p.y), floor = 1e-5 * objectBounds().max.x;
  Vec3d radial{p.x, p.y, 0};
  if (distance < floor) radial = distance > 0 ? floor / distance * radial : Vec3d(floor, 0, 0);
  return {.dpdu = phi * Vec3d(-radial.y, radial.x, 0),
          .dpdv = dpdv,
          .d2pduu = -phi * phi * radial,
          .d2pduv = phi * Vec3d(-dpdv.y, dpdv.x, 0),
          .d2pdvv = {}};
}

}  // namespace pbrtmedia
