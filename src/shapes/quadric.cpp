// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/quadric.h"

#include <algorithm>

namespace pbrtmedia {
namespace {

/// Relative difference of lengths and angles up to which a placement counts as a uniform scale.
constexpr double kSimilarity = 1e-12;
constexpr int kAreaSteps = 256;  // per direction, of the quadrature of `area`

double frobenius(const Matrix4& m) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) sum += sqr(m.m[i][j]);
  }
  return std::sqrt(sum);
}

bool isSimilarity(const Transform& t) {
  const Vec3d x = t.vector(Vec3d(1, 0, 0)), y = t.vector(Vec3d(0, 1, 0)), z = t.vector(Vec3d(0, 0, 1));
  const double xx = lengthSquared(x), tolerance = kSimilarity * xx;
  return std::abs(lengthSquared(y) - xx) <= tolerance && std::abs(lengthSquared(z) - xx) <= tolerance &&
         absDot(x, y) <= tolerance && absDot(y, z) <= tolerance && absDot(z, x) <= tolerance;
}

/// The roots of the line's equation that may be hit, in ascending order.
struct Roots {
  std::array<double, 2> t{};
  std::size_t count = 0;
};

/// Leaves out the root nearest to each value of `excluded` (all on this line). A ray that starts on the
/// surface leaves out one of two roots; when it grazes, rounding of the start may leave the equation without
/// real roots, and then the other root follows from their sum. Two different values leave out both.
Roots openRoots(const std::array<double, 3>& equation, std::span<const float> excluded, double shift) {
  const auto [a, b, c] = equation;
  const bool excludesTwo = std::ranges::any_of(excluded, [&](float e) { return e != excluded.front(); });
  double t0, t1;
  if (!solveQuadratic(a, b, c, t0, t1)) {
    if (excluded.empty() || excludesTwo || a == 0) return {};
    return {.t = {-b / a - (excluded.front() - shift), 0}, .count = 1};
  }
  const bool isLinear = a == 0;
  if (excluded.empty()) return {.t = {t0, t1}, .count = isLinear ? 1u : 2u};
  if (excludesTwo || isLinear) return {};
  const double e = excluded.front() - shift;
  return {.t = {std::abs(e - t0) <= std::abs(e - t1) ? t1 : t0, 0}, .count = 1};
}

}  // namespace

Quadric::Quadric(const ShapePlacement& placement)
    : worldFromObject_(placement.worldFromObject),
      objectFromWorld_(placement.worldFromObject.inverse()),
      flips_(placement.flipsNormal()),
      isSimilarity_(isSimilarity(placement.worldFromObject)),
      volumeScale_(std::abs(placement.worldFromObject.matrix().determinant3())),
      inverseScale_(frobenius(placement.worldFromObject.inverseMatrix())) {}

Bounds3f Quadric::bounds() const {
  const Bounds3d b = objectBounds();
  Bounds3f r;
  for (int i = 0; i < 8; ++i) r.expand(Point3f(worldFromObject_.point(b.corner(i))));
  for (std::size_t i = 0; i < 3; ++i) {
    r.min[i] = std::nextafter(r.min[i], -kInfinity);
    r.max[i] = std::nextafter(r.max[i], kInfinity);
  }
  return r;
}

Quadric::ObjectRay Quadric::objectRay(const Ray& ray) const {
  const Vec3d o = objectFromWorld_.point(Vec3d(ray.o)), d = objectFromWorld_.vector(Vec3d(ray.d));
  const double dd = lengthSquared(d);
  const double shift = dd > 0 ? dot(objectBounds().centre() - o, d) / dd : 0;
  return {o + shift * d, d, shift};
}

std::optional<UserGeometry::Root> Quadric::intersect(std::uint32_t, const Ray& ray, double tMin, double tMax,
                                                     std::span<const float> excludedT) const {
  const ObjectRay r = objectRay(ray);
  const bool startsHere = tMin <= 0 && excludedT.size() == 1 && excludedT.front() == 0;
  if (startsHere && stopsAtStart(r.o - r.shift * r.d, r.d)) {
    return Root{0, Point2f(parameters(project(r.o - r.shift * r.d)))};
  }
  const Roots roots = openRoots(lineEquation(r.o, r.d), excludedT, r.shift);
  for (std::size_t i = 0; i < roots.count; ++i) {
    const double t = roots.t[i] + r.shift;
    const auto rounded = static_cast<float>(t);
    if (!std::isfinite(rounded) || rounded < tMin || rounded > tMax) continue;
    const Vec3d p = project(r.o + roots.t[i] * r.d);
    if (contains(p)) return Root{t, Point2f(parameters(p))};
  }
  return std::nullopt;
}

// The root is solved again rather than taken from hit.t, whose rounding grows with the distance of the
// origin.
Vec3d Quadric::nearestPoint(const RayHit& hit, const Ray& ray) const {
  const ObjectRay r = objectRay(ray);
  const double reported = hit.t - r.shift;
  double t = reported;
  const Roots roots = openRoots(lineEquation(r.o, r.d), {}, r.shift);
  for (std::size_t i = 0; i < roots.count; ++i) {
    if (i == 0 || std::abs(roots.t[i] - reported) < std::abs(t - reported)) t = roots.t[i];
  }
  return project(r.o + t * r.d);
}

SurfaceInteraction Quadric::interaction(const RayHit& hit, const Ray& ray) const {
  const Vec3d p = nearestPoint(hit, ray), n = normal(p);
  const Derivatives d = derivatives(p);

  // Weingarten equations: the normal's derivatives from the fundamental forms.
  const double E = dot(d.dpdu, d.dpdu), F = dot(d.dpdu, d.dpdv), G = dot(d.dpdv, d.dpdv);
  const double e = dot(n, d.d2pduu), f = dot(n, d.d2pduv), g = dot(n, d.d2pdvv);
  const double determinant = E * G - F * F;
  const double inverse = determinant > 0 ? 1 / determinant : 0;
  const Vec3d dndu = inverse * ((f * F - e * G) * d.dpdu + (e * F - f * E) * d.dpdv);
  const Vec3d dndv = inverse * ((g * F - f * G) * d.dpdu + (f * F - g * E) * d.dpdv);

  SurfaceInteraction si;
  si.p = Point3f(p);
  si.time = ray.time;
  si.wo = Vector3f(normalize(objectFromWorld_.vector(-Vec3d(ray.d))));
  const double sign = flips_ ? -1 : 1;
  si.n = Normal3f(sign * n);
  const Point2d uv = parameters(p);
  si.uv = Point2f(Point2d(std::clamp(uv.x, 0.0, 1.0), std::clamp(uv.y, 0.0, 1.0)));
  si.dpdu = Vector3f(d.dpdu);
  si.dpdv = Vector3f(d.dpdv);
  si.dndu = Normal3f(dndu);
  si.dndv = Normal3f(dndv);
  si.shading = {si.n, si.dpdu, si.dpdv, si.dndu, si.dndv};
  si.primitive = hit.id;

  SurfaceInteraction world = transformInteraction(worldFromObject_, si);
  world.p = Point3f(worldFromObject_.point(p));  // rounded once
  world.wo = Vector3f(normalize(-Vec3d(ray.d)));
  return world;
}

double Quadric::areaScale(Vec3d nObject) const {
  return volumeScale_ * length(worldFromObject_.normal(nObject));
}

double Quadric::area(std::uint32_t) const {
  if (isSimilarity_) return objectArea() * areaScale({0, 0, 1});
  double sum = 0;  // midpoint rule over uniform samples of the object-space area
  for (int i = 0; i < kAreaSteps; ++i) {
    for (int j = 0; j < kAreaSteps; ++j) {
      const Point2d u((i + 0.5) / kAreaSteps, (j + 0.5) / kAreaSteps);
      sum += areaScale(surfaceNormal(sampleObject(u)));
    }
  }
  return objectArea() * sum / sqr(kAreaSteps);
}

double Quadric::areaSampledByPbrt(std::uint32_t) const { return objectArea(); }

ShapeSample Quadric::sampleAt(Vec3d pObject) const {
  const Vec3d n = normal(pObject), mapped = worldFromObject_.normal(n);
  const auto pdf = static_cast<float>(1 / (objectArea() * areaScale(surfaceNormal(pObject))));
  return {.p = Point3f(worldFromObject_.point(pObject)),
          .n = Normal3f((flips_ ? -1 : 1) / length(mapped) * mapped),
          .pdf = std::isfinite(pdf) ? pdf : 0};
}

ShapeSample Quadric::sample(std::uint32_t, Point2f u) const { return sampleAt(sampleObject(Point2d(u))); }

double Quadric::areaDensity(std::uint32_t, Normal3f n) const {
  // The unit object normal is M^T n / |M^T n|, so the area scale there is |det M| / |M^T n|.
  return length(objectFromWorld_.normal(Vec3d(n))) / (objectArea() * volumeScale_);
}

float Quadric::pdf(std::uint32_t primitive, Point3f reference, Vector3f, Point3f p, Normal3f n) const {
  const Vec3d toPoint = Vec3d(p) - Vec3d(reference);
  const double d = length(toPoint);
  const auto pdf = static_cast<float>(areaDensity(primitive, n) * d * d * d / absDot(Vec3d(n), toPoint));
  return std::isfinite(pdf) ? pdf : 0;
}

}  // namespace pbrtmedia
