// SPDX-License-Identifier: BSD-2-Clause
#include "base/transform.h"

#include <cmath>

namespace pbrtmedia {
namespace {

/// With the homogeneous division.
Vec3d mappedPoint(const Matrix4& matrix, Vec3d p) {
  const auto& m = matrix.m;
  const Vec3d q{m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
                m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
                m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
  const double w = m[3][0] * p.x + m[3][1] * p.y + m[3][2] * p.z + m[3][3];
  return w == 1 ? q : q / w;
}

Vec3d mappedVector(const Matrix4& matrix, Vec3d v) {
  const auto& m = matrix.m;
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

}  // namespace

Matrix4 operator*(const Matrix4& a, const Matrix4& b) {
  Matrix4 r;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      r.m[i][j] =
          a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] + a.m[i][3] * b.m[3][j];
    }
  }
  return r;
}

Matrix4 Matrix4::transposed() const {
  Matrix4 r;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) r.m[i][j] = m[j][i];
  }
  return r;
}

double Matrix4::determinant3() const {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Matrix4 Matrix4::inverse(bool& singular) const {
  std::array<std::array<double, 8>, 4> a{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) a[i][j] = m[i][j];
    a[i][i + 4] = 1;
  }
  for (std::size_t column = 0; column < 4; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < 4; ++row) {
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    }
    if (!(std::abs(a[pivot][column]) > 0) || !std::isfinite(a[pivot][column])) {
      singular = true;
      return {};
    }
    std::swap(a[column], a[pivot]);
    const double scale = 1 / a[column][column];
    for (double& x : a[column]) x *= scale;
    for (std::size_t row = 0; row < 4; ++row) {
      if (row == column) continue;
      const double factor = a[row][column];
      if (factor == 0) continue;
      for (std::size_t j = 0; j < 8; ++j) a[row][j] -= factor * a[column][j];
    }
  }
  singular = false;
  Matrix4 r;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) r.m[i][j] = a[i][j + 4];
  }
  return r;
}

Transform::Transform(const Matrix4& m) : m_(m), inv_(m.inverse(singular_)) {}

Transform Transform::translate(Vec3d d) {
  return {Matrix4{{{{1, 0, 0, d.x}, {0, 1, 0, d.y}, {0, 0, 1, d.z}, {0, 0, 0, 1}}}},
          Matrix4{{{{1, 0, 0, -d.x}, {0, 1, 0, -d.y}, {0, 0, 1, -d.z}, {0, 0, 0, 1}}}}};
}

Transform Transform::scale(double x, double y, double z) {
  return Transform(Matrix4{{{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}, {0, 0, 0, 1}}}});
}

Transform Transform::rotate(double degrees, Vec3d axis) {
  const Vec3d a = normalize(axis);
  // Multiples of a right angle are exact, so that axis-aligned scenes stay axis-aligned.
  const double turns = std::fmod(degrees, 360.0);
  double s = std::sin(turns * (std::numbers::pi / 180)), c = std::cos(turns * (std::numbers::pi / 180));
  if (std::fmod(turns, 90.0) == 0) {
    s = std::round(s);
    c = std::round(c);
  }
  const double k = 1 - c;
  const Matrix4 m{{{{c + k * a.x * a.x, k * a.x * a.y - s * a.z, k * a.x * a.z + s * a.y, 0},
                    {k * a.x * a.y + s * a.z, c + k * a.y * a.y, k * a.y * a.z - s * a.x, 0},
                    {k * a.x * a.z - s * a.y, k * a.y * a.z + s * a.x, c + k * a.z * a.z, 0},
                    {0, 0, 0, 1}}}};
  return {m, m.transposed()};
}

std::optional<Transform> Transform::lookAt(Vec3d eye, Vec3d look, Vec3d up) {
  const Vec3d view = look - eye;
  if (!(lengthSquared(view) > 0) || !(lengthSquared(up) > 0)) return std::nullopt;
  const Vec3d d = normalize(view);
  const Vec3d side = cross(normalize(up), d);
  constexpr double kParallel = 1e-12;  // sine; rounding leaves about 1e-16
  if (!(lengthSquared(side) > kParallel * kParallel)) return std::nullopt;
  const Vec3d r = normalize(side), u = cross(d, r);
  const Matrix4 cameraToWorld{
      {{{r.x, u.x, d.x, eye.x}, {r.y, u.y, d.y, eye.y}, {r.z, u.z, d.z, eye.z}, {0, 0, 0, 1}}}};
  return Transform(cameraToWorld).inverse();
}

Transform Transform::perspective(double fovDegrees, double n, double f) {
  const Matrix4 project{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, f / (f - n), -f * n / (f - n)}, {0, 0, 1, 0}}}};
  const double k = 1 / std::tan(fovDegrees * (std::numbers::pi / 180) / 2);
  return scale(k, k, 1) * Transform(project);
}

Transform Transform::inverse() const {
  Transform r(inv_, m_);
  r.singular_ = singular_;
  return r;
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform r(a.m_ * b.m_, b.inv_ * a.inv_);
  r.singular_ = a.singular_ || b.singular_;
  return r;
}

Vec3d Transform::point(Vec3d p) const { return mappedPoint(m_, p); }
Vec3d Transform::inversePoint(Vec3d p) const { return mappedPoint(inv_, p); }
Vec3d Transform::vector(Vec3d v) const { return mappedVector(m_, v); }
Vec3d Transform::inverseVector(Vec3d v) const { return mappedVector(inv_, v); }

Vec3d Transform::normal(Vec3d n) const {
  const auto& m = inv_.m;
  return {m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z, m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
          m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z};
}

Ray Transform::ray(const Ray& r) const { return {point(r.o), vector(r.d), r.tMax, r.time}; }

RayDifferential Transform::ray(const RayDifferential& r) const {
  RayDifferential q(ray(static_cast<const Ray&>(r)));
  q.hasDifferentials = r.hasDifferentials;
  if (r.hasDifferentials) {
    q.rxOrigin = point(r.rxOrigin);
    q.ryOrigin = point(r.ryOrigin);
    q.rxDirection = vector(r.rxDirection);
    q.ryDirection = vector(r.ryDirection);
  }
  return q;
}

Bounds3f Transform::bounds(const Bounds3f& b) const {
  Bounds3f r;
  if (b.isEmpty()) return r;
  for (int i = 0; i < 8; ++i) r.expand(point(b.corner(i)));
  return r;
}

Affine3f::Affine3f(const Matrix4& m) {
  const auto f = [&](std::size_t i, std::size_t j) { return static_cast<float>(m.m[i][j]); };
  x = {f(0, 0), f(1, 0), f(2, 0)};
  y = {f(0, 1), f(1, 1), f(2, 1)};
  z = {f(0, 2), f(1, 2), f(2, 2)};
  t = {f(0, 3), f(1, 3), f(2, 3)};
}

}  // namespace pbrtmedia
