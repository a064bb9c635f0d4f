// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/hyperboloid.h"

#include <algorithm>
#include <array>

#include "shapes/parameter_checks.h"

namespace pbrtmedia {
namespace {

constexpr int kMostSteps = 8;           // of the search for a second circle
constexpr double kSameRadius = 1e-5;    // relative: rounding of the ends
constexpr double kAxisDistance = 1e-5;  // relative: nearer to the axis than this, tangents are those at this

std::array<Vec3d, 2> orderedEnds(const Hyperboloid::Params& params) {
  const Vec3d a(params.p1), b(params.p2);
  if (b.z == 0) return {b, a};
  return {a, b};
}

/// Squared radius A + B z² of PBRT-v3's surface.
struct SquaredRadius {
  double a, b;
  double at(double z) const { return a + b * z * z; }
};

SquaredRadius squaredRadius(Vec3d p1, Vec3d p2) {
  const Vec3d twice = 2 * (p2 - p1);
  const double z2 = p2.z * p2.z, r2 = p2.x * p2.x + p2.y * p2.y;
  SquaredRadius found{r2, 0};
  Vec3d p = p1;
  for (int i = 0; i < kMostSteps; ++i) {
    p += twice;
    const double zz = p.z * p.z, rr = p.x * p.x + p.y * p.y;
    if (zz == z2) continue;
    found.b = (rr - r2) / (zz - z2);
    found.a = r2 - found.b * z2;
    // Cones through the origin are that at every step; PBRT-v3 goes on for ever.
    if (rr * z2 != r2 * zz) break;
  }
  return found;
}

/// Heights between p1 and p2 with PBRT-v3's surface.
struct Heights {
  double min, max, gap;
  bool isEmpty() const { return !(min < max) || (min >= -gap && max <= gap); }
};

Heights heightsOf(Vec3d p1, Vec3d p2, const SquaredRadius& r) {
  Heights h{std::min(p1.z, p2.z), std::max(p1.z, p2.z), 0};
  const double edge = r.a * r.b < 0 ? std::sqrt(-r.a / r.b) : 0;
  if (r.b > 0) {
    h.gap = edge;
    if (h.min > -edge) h.min = std::max(h.min, edge);
    if (h.max < edge) h.max = std::min(h.max, -edge);
    if (h.min >= edge || h.max <= -edge) h.gap = 0;
  } else if (r.b < 0) {
    h.min = std::max(h.min, -edge);
    h.max = std::min(h.max, edge);
  }
  return h;
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
  const SquaredRadius r = squaredRadius(p1, p2);
  const Heights heights = heightsOf(p1, p2, r);
  if (heights.isEmpty()) rejectParameter("p2", "a surface between p1 and p2", params.p2);
  return {.c0 = r.a,
          .c2 = r.b,
          .zMin = heights.min,
          .zMax = heights.max,
          .gap = heights.gap,
          .phiMax = sweepAngle(params.phimax),
          .normalSign = p2.z > p1.z ? 1.0 : -1.0};
}

bool Hyperboloid::isEmpty(const Params& params) {
  const auto [p1, p2] = orderedEnds(params);
  return heightsOf(p1, p2, squaredRadius(p1, p2)).isEmpty();
}

Hyperboloid::Waist Hyperboloid::waist(const Params& params) {
  const auto [p1, p2] = orderedEnds(params);
  const double swept = std::hypot(p1.x, p1.y), found = safeSqrt(squaredRadius(p1, p2).at(p1.z));
  return {std::abs(found - swept) > kSameRadius * std::max(swept, std::hypot(p2.x, p2.y)), found, swept};
}

Hyperboloid::Hyperboloid(const Params& params, const ShapePlacement& placement)
    : RevolvedQuadric(placement, profileOf(params)),
      p1_(orderedEnds(params)[0]),
      p2_(orderedEnds(params)[1]),
      isSwept_(!waist(params).isElsewhere) {}

double Hyperboloid::vAt(double z) const { return (z - p1_.z) / (p2_.z - p1_.z); }

RevolvedQuadric::HeightDerivatives Hyperboloid::heightDerivatives(double) const { return {p2_.z - p1_.z, 0}; }

double Hyperboloid::phase(double z) const {
  const Vec3d p = p1_ + vAt(z) * (p2_ - p1_);
  return std::atan2(p.y, p.x);
}

Vec3d Hyperboloid::normal(Vec3d p) const {
  if (isSwept_) return surfaceNormal(p);
  const Derivatives d = derivatives(p);
  return normalize(cross(d.dpdu, d.dpdv));
}

bool Hyperboloid::stopsAtStart(Vec3d o, Vec3d d) const {
  if (isSwept_) return false;
  const Vec3d p = project(o);
  return dot(d, normal(p)) * dot(d, surfaceNormal(p)) < 0;
}

float Hyperboloid::solidAngleDensity(Point3f reference, Vec3d pObject) const {
  const Vec3d n = worldFromObject().normal(surfaceNormal(pObject)), p = worldFromObject().point(pObject);
  const Vec3d toPoint = p - Vec3d(reference);
  // The area density in the world is 1 / (object area |det M| |M^-T n|); times d² / |cos|.
  const double d = length(toPoint);
  const auto pdf = static_cast<float>(d * d * d / (objectArea() * volumeScale() * std::abs(dot(n, toPoint))));
  return std::isfinite(pdf) ? pdf : 0;
}

ShapeSample Hyperboloid::sample(std::uint32_t, Point3f reference, Point2f u) const {
  const Vec3d p = sampleObject(Point2d(u));
  ShapeSample s = sampleAt(p);
  s.pdf = solidAngleDensity(reference, p);
  return s;
}

float Hyperboloid::pdf(std::uint32_t, Point3f reference, Vector3f, Point3f p, Normal3f) const {
  return solidAngleDensity(reference, project(objectPoint(Vec3d(p))));
}

Quadric::Derivatives Hyperboloid::derivatives(Vec3d p) const {
  const double phi = profile().phiMax, angle = azimuth(p);
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const Vec3d along = p2_ - p1_;
  const Vec3d dpdv{cosine * along.x - sine * along.y, sine * along.x + cosine * along.y, along.z};
  // On the axis the tangent of a small circle around it.
  const double distance = std::hypot(p.x, p.y), floor = kAxisDistance * objectBounds().max.x;
  Vec3d radial{p.x, p.y, 0};
  if (distance < floor) radial = distance > 0 ? floor / distance * radial : Vec3d(floor, 0, 0);
  return {.dpdu = phi * Vec3d(-radial.y, radial.x, 0),
          .dpdv = dpdv,
          .d2pduu = -phi * phi * radial,
          .d2pduv = phi * Vec3d(-dpdv.y, dpdv.x, 0),
          .d2pdvv = {}};
}

}  // namespace pbrtmedia
