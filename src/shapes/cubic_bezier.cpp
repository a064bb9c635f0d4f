// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/cubic_bezier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pbrtmedia {
namespace {

constexpr int kMostHalvings = 10;

Vec3d mix(double t, Vec3d a, Vec3d b) { return (1 - t) * a + t * b; }

/// The quadratic with these control points.
CubicBezier elevated(Vec3d a, Vec3d b, Vec3d c) { return {{a, mix(2.0 / 3, a, b), mix(1.0 / 3, b, c), c}}; }

/// The value of the polar form: the curve at (u, v, w), symmetric and affine in each.
Vec3d polar(const CubicBezier& c, double u, double v, double w) {
  const Vec3d a = mix(u, c.p[0], c.p[1]), b = mix(u, c.p[1], c.p[2]), d = mix(u, c.p[2], c.p[3]);
  return mix(w, mix(v, a, b), mix(v, b, d));
}

}  // namespace

Vec3d CubicBezier::at(double u) const { return polar(*this, u, u, u); }

Vec3d CubicBezier::derivative(double u) const {
  const Vec3d a = p[1] - p[0], b = p[2] - p[1], c = p[3] - p[2];
  return 3 * mix(u, mix(u, a, b), mix(u, b, c));
}

std::pair<CubicBezier, CubicBezier> CubicBezier::halves() const {
  const Vec3d a = 0.5 * (p[0] + p[1]), b = 0.5 * (p[1] + p[2]), c = 0.5 * (p[2] + p[3]);
  const Vec3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), middle = 0.5 * (ab + bc);
  return {{{p[0], a, ab, middle}}, {{middle, bc, c, p[3]}}};
}

CubicBezier CubicBezier::part(double u0, double u1) const {
  return {{polar(*this, u0, u0, u0), polar(*this, u0, u0, u1), polar(*this, u0, u1, u1),
           polar(*this, u1, u1, u1)}};
}

int CubicBezier::halvingsWithin(double maxDistance) const {
  const Vec3d bend = max(abs(p[0] - 2.0 * p[1] + p[2]), abs(p[1] - 2.0 * p[2] + p[3]));
  const double ratio = std::numbers::sqrt2 * 6 * maxComponent(bend) / (8 * maxDistance);
  if (!(ratio >= 1)) return 0;
  return static_cast<int>(std::min(std::floor(std::log2(ratio)) / 2, double{kMostHalvings}));
}

std::size_t curveSegmentCount(std::size_t points, int degree, CurveBasis basis) {
  const auto d = static_cast<std::size_t>(degree);
  if (points < d + 1) return 0;
  if (basis == CurveBasis::BSpline) return points - d;
  return (points - 1) % d == 0 ? (points - 1) / d : 0;
}

CubicBezier curveSegment(std::span<const Point3f> points, std::size_t segment, int degree, CurveBasis basis) {
  const std::size_t first =
      basis == CurveBasis::Bezier ? segment * static_cast<std::size_t>(degree) : segment;
  const auto p = [&](std::size_t i) { return Vec3d(points[first + i]); };
  if (degree == 2) {
    if (basis == CurveBasis::Bezier) return elevated(p(0), p(1), p(2));
    return elevated(mix(0.5, p(0), p(1)), p(1), mix(0.5, p(1), p(2)));
  }
  if (basis == CurveBasis::Bezier) return {{p(0), p(1), p(2), p(3)}};
  const Vec3d a = mix(1.0 / 3, p(1), p(2)), b = mix(2.0 / 3, p(1), p(2));
  return {{mix(0.5, mix(2.0 / 3, p(0), p(1)), a), a, b, mix(0.5, b, mix(1.0 / 3, p(2), p(3)))}};
}

}  // namespace pbrtmedia
