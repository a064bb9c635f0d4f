// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace pbrtmedia {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr double kTwoPi = 2 * std::numbers::pi;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
inline constexpr float kInv2Pi = 0.5f * std::numbers::inv_pi_v<float>;
inline constexpr float kInv4Pi = 0.25f * std::numbers::inv_pi_v<float>;
/// Largest float below 1: the upper end of every uniform number.
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

template <class T>
constexpr T lerp(T t, T a, T b) {
  return (T(1) - t) * a + t * b;
}
template <class T>
constexpr T sqr(T x) {
  return x * x;
}
template <class T>
constexpr T radians(T degrees) {
  return degrees * (std::numbers::pi_v<T> / T(180));
}
template <class T>
constexpr T degrees(T rad) {
  return rad * (T(180) / std::numbers::pi_v<T>);
}
/// sqrt that treats a slightly negative argument (a rounding leftover) as 0.
template <class T>
T safeSqrt(T x) {
  return std::sqrt(x > T(0) ? x : T(0));
}

/// Smallest interval [lo, hi] that holds the real roots of a t^2 + b t + c; false when there is none.
/// Computed without cancellation (q = -(b + sign(b) sqrt(D)) / 2). A zero `a` is solved as a linear equation.
inline bool solveQuadratic(double a, double b, double c, double& t0, double& t1) {
  if (a == 0.0) {
    if (b == 0.0) return false;
    t0 = t1 = -c / b;
    return std::isfinite(t0);
  }
  // b^2 - 4ac with the product's rounding error folded back in (Kahan).
  const double p = b * b, q = 4.0 * a * c;
  double d = p - q;
  if (3.0 * std::abs(d) < p + std::abs(q)) d += std::fma(b, b, -p) - std::fma(4.0 * a, c, -q);
  if (!(d >= 0.0)) return false;
  const double h = -0.5 * (b + std::copysign(std::sqrt(d), b));
  t0 = h / a;
  t1 = h != 0.0 ? c / h : t0;
  if (t0 > t1) {
    const double s = t0;
    t0 = t1;
    t1 = s;
  }
  return true;
}

}  // namespace pbrtmedia
