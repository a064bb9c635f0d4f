// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/nurbs.h"

#include <string>

#include "shapes/grid_indices.h"
#include "shapes/parameter_checks.h"

namespace pbrtmedia {
namespace {

/// Homogeneous point.
struct Vec4 {
  Vec3d p{};
  double w = 0;
  friend Vec4 operator+(const Vec4& a, const Vec4& b) { return {a.p + b.p, a.w + b.w}; }
  friend Vec4 operator*(double s, const Vec4& a) { return {s * a.p, s * a.w}; }
};

struct CurvePoint {
  Vec4 value, derivative;
};

/// One direction of the patch.
struct Direction {
  int count, order;
  const std::vector<float>& knots;
  double low = 0, high = 0;

  double knot(int i) const { return knots[static_cast<std::size_t>(i)]; }
  /// The non-empty knot interval [knot(k), knot(k + 1)] that holds t.
  int interval(double t) const {
    int k = count - 1;
    while (k > order - 1 && (knot(k) > t || knot(k) == knot(k + 1))) --k;
    while (knot(k) == knot(k + 1)) ++k;
    return k;
  }
};

/// de Boor's algorithm on the `order` control points that act on interval `k`.
CurvePoint deBoor(const Direction& direction, int k, double t, std::vector<Vec4> d) {
  const int degree = direction.order - 1;
  Vec4 derivative;
  for (int level = 1; level <= degree; ++level) {
    if (level == degree) {
      const double scale = degree / (direction.knot(k + 1) - direction.knot(k));
      const auto last = static_cast<std::size_t>(degree);
      derivative = scale * (d[last] + -1.0 * d[last - 1]);
    }
    for (int j = degree; j >= level; --j) {
      const double a = direction.knot(k - degree + j), b = direction.knot(k + j - level + 1);
      const double f = (t - a) / (b - a);
      const auto i = static_cast<std::size_t>(j);
      d[i] = (1 - f) * d[i - 1] + f * d[i];
    }
  }
  return {d[static_cast<std::size_t>(degree)], derivative};
}

void checkDirection(Direction& direction, const char* letter, std::optional<float> low,
                    std::optional<float> high) {
  const std::string name(letter);
  if (direction.order < 2) rejectParameter(name + "order", "at least 2 (degree + 1)", direction.order);
  if (direction.count < direction.order) {
    rejectParameter("n" + name, "at least as many control points as " + name + "order", direction.count);
  }
  const auto expected = static_cast<std::size_t>(direction.count) + static_cast<std::size_t>(direction.order);
  if (direction.knots.size() != expected) {
    rejectParameter(name + "knots", std::to_string(expected) + " numbers (n" + name + " + " + name + "order)",
                    direction.knots.size());
  }
  for (std::size_t i = 0; i < expected; ++i) {
    if (!std::isfinite(direction.knots[i]) || (i > 0 && direction.knots[i] < direction.knots[i - 1])) {
      rejectParameter(name + "knots[" + std::to_string(i) + "]", "a finite number not below its predecessor",
                      direction.knots[i]);
    }
  }
  const double first = direction.knot(direction.order - 1), last = direction.knot(direction.count);
  if (!(first < last)) rejectParameter(name + "knots", "a valid range that is not empty", first);
  direction.low = low ? static_cast<double>(*low) : first;
  direction.high = high ? static_cast<double>(*high) : last;
  const std::string range = " in the valid range " + std::to_string(first) + " to " + std::to_string(last);
  if (!(direction.low >= first && direction.low <= last))
    rejectParameter(name + "0", "a number" + range, direction.low);
  if (!(direction.high > direction.low && direction.high <= last)) {
    rejectParameter(name + "1", "a number above " + name + "0" + range, direction.high);
  }
}

std::vector<Vec4> controlPoints(const NurbsParams& params) {
  const auto count = static_cast<std::size_t>(params.nu) * static_cast<std::size_t>(params.nv);
  std::vector<Vec4> points;
  if (params.Pw.empty()) {
    if (params.P.size() != count)
      rejectParameter("P", std::to_string(count) + " points (nu * nv)", params.P.size());
    points.reserve(count);
    for (const Point3f& p : params.P) points.push_back({Vec3d(p), 1});
    return points;
  }
  if (params.Pw.size() != 4 * count) {
    rejectParameter("Pw", std::to_string(4 * count) + " numbers (4 * nu * nv)", params.Pw.size());
  }
  points.reserve(count);
  for (std::size_t i = 0; i < params.Pw.size(); i += 4) {
    points.push_back({Vec3d(params.Pw[i], params.Pw[i + 1], params.Pw[i + 2]), params.Pw[i + 3]});
  }
  return points;
}

}  // namespace

TriangleMesh::Params tessellateNurbs(const NurbsParams& params) {
  Direction u{params.nu, params.uorder, params.uknots}, v{params.nv, params.vorder, params.vknots};
  checkDirection(u, "u", params.u0, params.u1);
  checkDirection(v, "v", params.v0, params.v1);
  const std::vector<Vec4> control = controlPoints(params);

  TriangleMesh::Params mesh;
  constexpr int n = NurbsParams::kVertices;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double s = lerp(static_cast<double>(i) / (n - 1), u.low, u.high);
      const double t = lerp(static_cast<double>(j) / (n - 1), v.low, v.high);
      const int ku = u.interval(s), kv = v.interval(t);
      std::vector<Vec4> values, derivatives;  // of the rows along u
      for (int row = kv - v.order + 1; row <= kv; ++row) {
        const auto first = control.begin() + static_cast<std::ptrdiff_t>(row) * u.count + (ku - u.order + 1);
        const CurvePoint c = deBoor(u, ku, s, {first, first + u.order});
        values.push_back(c.value);
        derivatives.push_back(c.derivative);
      }
      const CurvePoint point = deBoor(v, kv, t, std::move(values));
      const Vec4 du = deBoor(v, kv, t, std::move(derivatives)).value;
      // Quotient rule for p / w; the common factor 1 / w keeps its sign out of the normal.
      const Vec3d p = point.value.p / point.value.w;
      const Vec3d dpdu = (du.p - du.w * p) / point.value.w;
      const Vec3d dpdv = (point.derivative.p - point.derivative.w * p) / point.value.w;
      const Vec3d normal = cross(dpdu, dpdv);
      const double size = length(normal);
      if (!isFinite(Point3f(p))) {
        rejectParameter("Pw", "weights that do not vanish on the surface", "a point at infinity");
      }
      mesh.P.emplace_back(p);
      mesh.N.emplace_back(size > 0 ? normal / size : Vec3d{});  // zero: the triangle's own normal is used
      mesh.uv.emplace_back(static_cast<float>(s), static_cast<float>(t));
    }
  }
  mesh.indices = gridIndices(n, n);
  return mesh;
}

}  // namespace pbrtmedia
