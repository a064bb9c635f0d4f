// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pbrtmedia {

/// A range of real numbers, lo <= hi. Functions of it contain every value the function takes on it, up to the
/// rounding of double; whoever needs a strict bound adds that.
struct Interval {
  double lo = 0, hi = 0;

  constexpr double width() const { return hi - lo; }
  constexpr bool contains(double x) const { return x >= lo && x <= hi; }

  friend constexpr Interval operator+(Interval a, Interval b) { return {a.lo + b.lo, a.hi + b.hi}; }
  friend constexpr Interval operator-(Interval a, Interval b) { return {a.lo - b.hi, a.hi - b.lo}; }
  friend constexpr Interval operator+(Interval a, double b) { return {a.lo + b, a.hi + b}; }
  friend constexpr Interval operator-(Interval a, double b) { return {a.lo - b, a.hi - b}; }
  friend constexpr Interval operator*(Interval a, double b) {
    return b < 0 ? Interval{a.hi * b, a.lo * b} : Interval{a.lo * b, a.hi * b};
  }
  friend constexpr Interval operator*(Interval a, Interval b) {
    const auto [least, most] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
    return {least, most};
  }
};

/// Both ends through a function that never falls.
template <class F>
Interval mapRising(Interval x, F&& f) {
  return {f(x.lo), f(x.hi)};
}
inline Interval square(Interval x) {
  const double a = x.lo * x.lo, b = x.hi * x.hi;
  return {x.lo <= 0 && x.hi >= 0 ? 0.0 : std::min(a, b), std::max(a, b)};
}
inline Interval cosine(Interval x) {
  constexpr double kTurn = 2 * std::numbers::pi;
  // A multiple of the turn (shifted by half of one) inside the range is a maximum (minimum).
  const auto meets = [&](double phase) {
    return std::floor((x.hi - phase) / kTurn) >= std::ceil((x.lo - phase) / kTurn);
  };
  const double a = std::cos(x.lo), b = std::cos(x.hi);
  return {meets(std::numbers::pi) ? -1.0 : std::min(a, b), meets(0) ? 1.0 : std::max(a, b)};
}
inline Interval sine(Interval x) { return cosine(x - std::numbers::pi / 2); }
inline Interval clamped(Interval x, double lo, double hi) {
  return {std::clamp(x.lo, lo, hi), std::clamp(x.hi, lo, hi)};
}

}  // namespace pbrtmedia
