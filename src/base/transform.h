// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <optional>

#include "base/bounds.h"
#include "base/ray.h"
#include "base/vec.h"

namespace pbrtmedia {

/// 4 x 4 matrix in double, rows first, acting on column vectors: p' = M p.
struct Matrix4 {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  bool operator==(const Matrix4&) const = default;
  friend Matrix4 operator*(const Matrix4& a, const Matrix4& b);
  Matrix4 transposed() const;
  /// Determinant of the upper-left 3 x 3 part.
  double determinant3() const;
  /// Gauss-Jordan with partial pivoting. `singular` tells when no inverse exists; the result is then the
  /// identity.
  Matrix4 inverse(bool& singular) const;
};

/// An invertible affine (or projective) map and its inverse. Composed in double, applied in double and
/// rounded once to float, so long transform chains and far origins cost no accuracy. Hot loops take an
/// `Affine3f`.
class Transform {
 public:
  Transform() = default;  ///< identity
  /// Inverts `m`; a singular matrix is flagged by `isSingular()` and has the identity as inverse.
  explicit Transform(const Matrix4& m);
  Transform(const Matrix4& m, const Matrix4& inverse) : m_(m), inv_(inverse) {}

  static Transform translate(Vec3d delta);
  static Transform scale(double x, double y, double z);
  /// Right-hand rotation by `degrees` about `axis` (any length > 0).
  static Transform rotate(double degrees, Vec3d axis);
  /// World-to-camera for an eye at `eye` looking at `look`: PBRT's left-handed camera space
  /// (scene-language reference 6.2). Nothing when `up` is parallel to the view (to 1e-12) or eye equals look.
  static std::optional<Transform> lookAt(Vec3d eye, Vec3d look, Vec3d up);
  /// Maps the camera-space frustum to PBRT screen space for the full angle `fovDegrees`.
  static Transform perspective(double fovDegrees, double nearZ, double farZ);

  const Matrix4& matrix() const { return m_; }
  const Matrix4& inverseMatrix() const { return inv_; }
  bool isSingular() const { return singular_; }
  bool isIdentity() const { return m_ == Matrix4{}; }
  /// True when the map mirrors (negative determinant of the linear part).
  bool swapsHandedness() const { return m_.determinant3() < 0; }
  Transform inverse() const;
  bool operator==(const Transform& o) const { return m_ == o.m_; }
  /// `(a * b)(p) = a(b(p))`.
  friend Transform operator*(const Transform& a, const Transform& b);

  Vec3d point(Vec3d p) const;   ///< with the homogeneous division
  Vec3d vector(Vec3d v) const;  ///< linear part
  Vec3d normal(Vec3d n) const;  ///< inverse transpose; not normalised
  Point3f point(Point3f p) const { return Point3f(point(Vec3d(p))); }
  Vector3f vector(Vector3f v) const { return Vector3f(vector(Vec3d(v))); }
  Normal3f normal(Normal3f n) const { return Normal3f(normal(Vec3d(n))); }
  /// Origin and direction mapped, direction not renormalised: t keeps its meaning.
  Ray ray(const Ray& r) const;
  RayDifferential ray(const RayDifferential& r) const;
  /// Box around the mapped corners.
  Bounds3f bounds(const Bounds3f& b) const;
  // Those of the inverse, which need not be made.
  Vec3d inversePoint(Vec3d p) const;
  Vec3d inverseVector(Vec3d v) const;

 private:
  bool singular_ = false;  // before inv_, whose initialiser sets it
  Matrix4 m_, inv_;
};

/// Single-precision affine map for hot loops: 12 floats, no inverse.
struct Affine3f {
  Vector3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< columns of the linear part
  Vector3f t{0, 0, 0};

  Affine3f() = default;
  explicit Affine3f(const Matrix4& m);
  Point3f point(Point3f p) const { return p.x * x + p.y * y + p.z * z + t; }
  Vector3f vector(Vector3f v) const { return v.x * x + v.y * y + v.z * z; }
};

}  // namespace pbrtmedia
