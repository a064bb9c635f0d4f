// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/revolved_quadric.h"

#include <algorithm>

#include "base/math.h"

namespace pbrtmedia {
namespace {

/// Tangents nearer to the axis than this fraction of the radius are those at this distance.
constexpr double kPoleRadius = 1e-5;
constexpr int kProjectionSteps = 2;  // Newton, from a point that is right to at least 1e-7
constexpr int kInversionSteps = 80;  // bisection alone would be done

}  // namespace

RevolvedQuadric::RevolvedQuadric(const ShapePlacement& placement, const Profile& profile)
    : Quadric(placement), profile_(profile) {
  const auto& [c0, c1, c2, zMin, zMax, gap, phiMax, clipsZ, sign] = profile_;
  double largest = std::max(profile_.radiusSquared(zMin), profile_.radiusSquared(zMax));
  if (c2 < 0) {
    const double equator = -c1 / (2 * c2);
    if (equator > zMin && equator < zMax) largest = std::max(largest, profile_.radiusSquared(equator));
  }
  largestRadius_ = safeSqrt(largest);
  // (r sqrt(1 + r'²))² = r² + (r r')² with r r' = (c1 + 2 c2 z) / 2
  a2_ = c2 + c2 * c2;
  a1_ = c1 + c1 * c2;
  a0_ = c0 + c1 * c1 / 4;
  bandMin_ = bandArea(zMin);
  bandMax_ = bandArea(zMax);
  area_ = phiMax * (bandMax_ - bandMin_);
}

Bounds3d RevolvedQuadric::objectBounds() const {
  return {{-largestRadius_, -largestRadius_, profile_.zMin}, {largestRadius_, largestRadius_, profile_.zMax}};
}

std::array<double, 3> RevolvedQuadric::lineEquation(Vec3d o, Vec3d d) const {
  const double c2 = profile_.c2;
  return {d.x * d.x + d.y * d.y - c2 * d.z * d.z, 2 * (o.x * d.x + o.y * d.y) - profile_.slope(o.z) * d.z,
          o.x * o.x + o.y * o.y - profile_.radiusSquared(o.z)};
}

Vec3d RevolvedQuadric::project(Vec3d p) const {
  for (int i = 0; i < kProjectionSteps; ++i) {
    const Vec3d gradient{2 * p.x, 2 * p.y, -profile_.slope(p.z)};
    const double steepness = lengthSquared(gradient);
    if (!(steepness > 0)) return p;  // apex of a cone
    const Vec3d next = p - (p.x * p.x + p.y * p.y - profile_.radiusSquared(p.z)) / steepness * gradient;
    if (!isFinite(next)) return p;
    p = next;
  }
  return p;
}

double RevolvedQuadric::azimuth(Vec3d p) const {
  const double phi = std::fmod(std::atan2(p.y, p.x) - phase(p.z), kTwoPi);
  return phi < 0 ? phi + kTwoPi : phi;
}

bool RevolvedQuadric::contains(Vec3d p) const {
  if (profile_.clipsZ && !(p.z >= profile_.zMin && p.z <= profile_.zMax)) return false;
  return profile_.phiMax >= kTwoPi || azimuth(p) <= profile_.phiMax;
}

Point2d RevolvedQuadric::parameters(Vec3d p) const { return {azimuth(p) / profile_.phiMax, vAt(p.z)}; }

Vec3d RevolvedQuadric::surfaceNormal(Vec3d p) const {
  const Vec3d gradient{p.x, p.y, -profile_.slope(p.z) / 2};
  const double size = length(gradient);
  if (!(size > 0)) return {0, 0, profile_.normalSign};
  return profile_.normalSign / size * gradient;
}

Quadric::Derivatives RevolvedQuadric::derivatives(Vec3d p) const {
  const double distance = std::hypot(p.x, p.y), r = std::max(distance, kPoleRadius * largestRadius_);
  const Vec3d radial = distance > 0 ? Vec3d(p.x / distance, p.y / distance, 0) : Vec3d(1, 0, 0);
  const Vec3d around{-radial.y, radial.x, 0};
  const double phi = profile_.phiMax;
  const auto [zv, zvv] = heightDerivatives(p.z);
  const double slope = profile_.slope(p.z) / (2 * r);          // r'
  const double curvature = (profile_.c2 - slope * slope) / r;  // r''
  return {.dpdu = phi * r * around,
          .dpdv = slope * zv * radial + Vec3d(0, 0, zv),
          .d2pduu = -phi * phi * r * radial,
          .d2pduv = phi * slope * zv * around,
          .d2pdvv = (curvature * zv * zv + slope * zvv) * radial + Vec3d(0, 0, zvv)};
}

double RevolvedQuadric::bandArea(double z) const {
  const double gap = profile_.gap;
  if (gap == 0 || z <= -gap) return bandAreaWithoutGap(z);
  const double below = bandAreaWithoutGap(-gap);
  return z < gap ? below : below + bandAreaWithoutGap(z) - bandAreaWithoutGap(gap);
}

double RevolvedQuadric::bandAreaWithoutGap(double z) const {
  const double q = std::max(0.0, a0_ + z * (a1_ + z * a2_));
  if (a2_ == 0) {
    if (a1_ == 0) return std::sqrt(a0_) * z;  // sphere, cylinder
    return 2 / (3 * a1_) * q * std::sqrt(q);  // paraboloid
  }
  // Integral of sqrt(q) = sqrt(a2 z² + a1 z + a0), by that of 1 / sqrt(q). The discriminant is 0 for a cone,
  // positive for one sheet, negative for two and for spheroids (a2 < 0 where those are prolate).
  const double x = 2 * a2_ * z + a1_, discriminant = 4 * a2_ * a0_ - a1_ * a1_;
  const double area = x / (4 * a2_) * std::sqrt(q);
  if (discriminant == 0) return area;
  const double relative = x / std::sqrt(std::abs(discriminant)), scale = std::sqrt(std::abs(a2_));
  double inverseRoot;
  if (a2_ < 0) {
    inverseRoot = -std::asin(std::clamp(relative, -1.0, 1.0));
  } else if (discriminant > 0) {
    inverseRoot = std::asinh(relative);
  } else {
    inverseRoot = std::copysign(std::acosh(std::max(1.0, std::abs(relative))), relative);
  }
  return area + discriminant / (8 * a2_ * scale) * inverseRoot;
}

double RevolvedQuadric::heightOfBand(double u) const {
  double low = profile_.zMin, high = profile_.zMax;
  if (a2_ == 0 && a1_ == 0) return lerp(u, low, high);
  const double target = lerp(u, bandMin_, bandMax_);
  double z = lerp(u, low, high);
  for (int i = 0; i < kInversionSteps && low < high; ++i) {  // Newton, kept inside a shrinking bracket
    const double error = bandArea(z) - target;
    (error > 0 ? high : low) = z;
    const double slope = std::sqrt(std::max(0.0, a0_ + z * (a1_ + z * a2_)));
    double next = z - error / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - z) <= 1e-15 * (std::abs(profile_.zMin) + std::abs(profile_.zMax))) return next;
    z = next;
  }
  return z;
}

Vec3d RevolvedQuadric::sampleObject(Point2d u) const {
  const double z = heightOfBand(u.x), r = safeSqrt(profile_.radiusSquared(z));
  const double phi = u.y * profile_.phiMax + phase(z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace pbrtmedia
