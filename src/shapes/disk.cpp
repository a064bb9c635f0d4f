// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/disk.h"

#include "base/math.h"
#include "shapes/parameter_checks.h"

namespace pbrtmedia {
namespace {

double azimuth(Vec3d p) {
  const double phi = std::atan2(p.y, p.x);
  return phi < 0 ? phi + kTwoPi : phi;
}

}  // namespace

Disk::Disk(const Params& params, const ShapePlacement& placement)
    : Quadric(placement),
      height_(params.height),
      radius_(params.radius),
      innerRadius_(params.innerradius),
      phiMax_(sweepAngle(params.phimax)) {
  requireFinite("height", params.height);
  requirePositive("radius", params.radius);
  if (!(params.innerradius >= 0 && params.innerradius < params.radius)) {
    rejectParameter("innerradius", "a number from 0 to below radius", params.innerradius);
  }
}

Bounds3d Disk::objectBounds() const { return {{-radius_, -radius_, height_}, {radius_, radius_, height_}}; }

std::array<double, 3> Disk::lineEquation(Vec3d o, Vec3d d) const { return {0, d.z, o.z - height_}; }

Vec3d Disk::project(Vec3d p) const { return {p.x, p.y, height_}; }

bool Disk::contains(Vec3d p) const {
  const double rr = p.x * p.x + p.y * p.y;
  if (rr > radius_ * radius_ || rr < innerRadius_ * innerRadius_) return false;
  return phiMax_ >= kTwoPi || azimuth(p) <= phiMax_;
}

Point2d Disk::parameters(Vec3d p) const {
  return {azimuth(p) / phiMax_, (radius_ - std::hypot(p.x, p.y)) / (radius_ - innerRadius_)};
}

Vec3d Disk::normal(Vec3d) const { return {0, 0, 1}; }

Quadric::Derivatives Disk::derivatives(Vec3d p) const {
  const double distance = std::hypot(p.x, p.y);
  const Vec3d radial = distance > 0 ? Vec3d(p.x / distance, p.y / distance, 0) : Vec3d(1, 0, 0);
  const Vec3d around{-radial.y, radial.x, 0};
  const double r = std::max(distance, 1e-5 * radius_);  // at the centre the tangent of a small circle
  return {.dpdu = phiMax_ * r * around,
          .dpdv = (innerRadius_ - radius_) * radial,
          .d2pduu = -phiMax_ * phiMax_ * r * radial,
          .d2pduv = phiMax_ * (innerRadius_ - radius_) * around,
          .d2pdvv = {}};
}

double Disk::objectArea() const { return phiMax_ / 2 * (radius_ * radius_ - innerRadius_ * innerRadius_); }

Vec3d Disk::sampleObject(Point2d u) const {
  const double r = std::sqrt(lerp(u.x, innerRadius_ * innerRadius_, radius_ * radius_)), phi = u.y * phiMax_;
  return {r * std::cos(phi), r * std::sin(phi), height_};
}

}  // namespace pbrtmedia
