// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <type_traits>
#include <utility>

namespace pbrtmedia {

/// Two numbers of one type. Used for film positions, (u,v) and samples in the unit square.
template <class T>
struct Vec2 {
  T x{}, y{};

  constexpr Vec2() = default;
  constexpr Vec2(T xx, T yy) : x(xx), y(yy) {}
  template <class U>
  constexpr explicit Vec2(const Vec2<U>& v) : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)) {}

  constexpr T& operator[](std::size_t i) { return i == 0 ? x : y; }
  constexpr T operator[](std::size_t i) const { return i == 0 ? x : y; }
  constexpr bool operator==(const Vec2&) const = default;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(Vec2 a, T s) { return {a.x * s, a.y * s}; }
  friend constexpr Vec2 operator*(T s, Vec2 a) { return {a.x * s, a.y * s}; }
  friend constexpr Vec2 operator/(Vec2 a, T s) { return {a.x / s, a.y / s}; }
  friend std::ostream& operator<<(std::ostream& os, const Vec2& v) {
    return os << '(' << v.x << ' ' << v.y << ')';
  }
};

/// Three numbers of one type: a point, a vector or a normal. The aliases below say which is meant; they are
/// one type, so a transform is applied by naming the rule (`point`, `vector`, `normal`), not by the argument.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr Vec3() = default;
  constexpr Vec3(T xx, T yy, T zz) : x(xx), y(yy), z(zz) {}
  template <class U>
  constexpr explicit Vec3(const Vec3<U>& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  constexpr T& operator[](std::size_t i) { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr T operator[](std::size_t i) const { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr bool operator==(const Vec3&) const = default;
  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  constexpr Vec3& operator-=(Vec3 b) { return *this = *this - b; }
  constexpr Vec3& operator*=(T s) { return *this = *this * s; }
  constexpr Vec3& operator/=(T s) { return *this = *this / s; }
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, Vec3 a) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator/(Vec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend std::ostream& operator<<(std::ostream& os, const Vec3& v) {
    return os << '(' << v.x << ' ' << v.y << ' ' << v.z << ')';
  }
};

using Point2f = Vec2<float>;
using Vector2f = Vec2<float>;
using Point2d = Vec2<double>;
using Point2i = Vec2<int>;
using Vector3f = Vec3<float>;
using Point3f = Vec3<float>;
using Normal3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Point3i = Vec3<int>;

template <class T>
constexpr T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr T absDot(Vec3<T> a, Vec3<T> b) {
  const T d = dot(a, b);
  return d < 0 ? -d : d;
}
/// Cross product; float input is multiplied in double, so nearly parallel vectors keep their digits.
template <class T>
constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  using D = std::conditional_t<std::is_same_v<T, float>, double, T>;
  const D ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
  return {static_cast<T>(ay * bz - az * by), static_cast<T>(az * bx - ax * bz),
          static_cast<T>(ax * by - ay * bx)};
}
template <class T>
constexpr T lengthSquared(Vec3<T> v) {
  return dot(v, v);
}
template <class T>
T length(Vec3<T> v) {
  return std::sqrt(lengthSquared(v));
}
/// v / |v|. A zero vector gives NaN: callers that can meet one test first.
template <class T>
Vec3<T> normalize(Vec3<T> v) {
  return v / length(v);
}
template <class T>
T distance(Vec3<T> a, Vec3<T> b) {
  return length(a - b);
}
template <class T>
constexpr Vec3<T> min(Vec3<T> a, Vec3<T> b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <class T>
constexpr Vec3<T> max(Vec3<T> a, Vec3<T> b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
template <class T>
Vec3<T> abs(Vec3<T> v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}
template <class T>
constexpr T maxComponent(Vec3<T> v) {
  return std::max(v.x, std::max(v.y, v.z));
}
template <class T>
bool isFinite(Vec3<T> v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
template <class T>
bool isFinite(Vec2<T> v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
/// n or -n, whichever lies in the hemisphere of v.
template <class T>
constexpr Vec3<T> faceForward(Vec3<T> n, Vec3<T> v) {
  return dot(n, v) < 0 ? -n : n;
}

/// Right-handed orthonormal basis (t, b, n) around the unit vector n: t × b = n.
/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1): no branch, no singularity.
template <class T>
std::pair<Vec3<T>, Vec3<T>> coordinateSystem(Vec3<T> n) {
  const T sign = std::copysign(T(1), n.z);
  const T a = T(-1) / (sign + n.z);
  const T b = n.x * n.y * a;
  return {{T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// Orthonormal frame: local (x, y, z) = (s, t, n).
struct Frame {
  Vector3f s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

  static Frame fromZ(Vector3f z) {
    const auto [a, b] = coordinateSystem(z);
    return {a, b, z};
  }
  Vector3f toLocal(Vector3f v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
  Vector3f toWorld(Vector3f v) const { return v.x * s + v.y * t + v.z * n; }
};

}  // namespace pbrtmedia
