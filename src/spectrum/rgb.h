// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>

namespace pbrtmedia {

/// Three linear channels with Rec. 709 primaries: radiance, reflectance, coefficient or weight. Unclamped.
struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr explicit Rgb(float v) : r(v), g(v), b(v) {}
  constexpr Rgb(float rr, float gg, float bb) : r(rr), g(gg), b(bb) {}

  constexpr float& operator[](std::size_t i) { return i == 0 ? r : (i == 1 ? g : b); }
  constexpr float operator[](std::size_t i) const { return i == 0 ? r : (i == 1 ? g : b); }
  constexpr bool operator==(const Rgb&) const = default;
  constexpr Rgb operator-() const { return {-r, -g, -b}; }
  constexpr Rgb& operator+=(Rgb o) { return *this = *this + o; }
  constexpr Rgb& operator-=(Rgb o) { return *this = *this - o; }
  constexpr Rgb& operator*=(Rgb o) { return *this = *this * o; }
  constexpr Rgb& operator*=(float s) { return *this = *this * s; }
  constexpr Rgb& operator/=(float s) { return *this = *this / s; }
  friend constexpr Rgb operator+(Rgb u, Rgb v) { return {u.r + v.r, u.g + v.g, u.b + v.b}; }
  friend constexpr Rgb operator-(Rgb u, Rgb v) { return {u.r - v.r, u.g - v.g, u.b - v.b}; }
  friend constexpr Rgb operator*(Rgb u, Rgb v) { return {u.r * v.r, u.g * v.g, u.b * v.b}; }
  friend constexpr Rgb operator*(Rgb a, float s) { return {a.r * s, a.g * s, a.b * s}; }
  friend constexpr Rgb operator*(float s, Rgb a) { return {a.r * s, a.g * s, a.b * s}; }
  friend constexpr Rgb operator/(Rgb u, Rgb v) { return {u.r / v.r, u.g / v.g, u.b / v.b}; }
  friend constexpr Rgb operator/(Rgb a, float s) { return {a.r / s, a.g / s, a.b / s}; }

  constexpr bool isBlack() const { return r == 0 && g == 0 && b == 0; }
  constexpr bool isGrey() const { return r == g && g == b; }
  bool isFinite() const { return std::isfinite(r) && std::isfinite(g) && std::isfinite(b); }
  /// Luminance: 0.212671 R + 0.715160 G + 0.072169 B.
  constexpr float luminance() const { return 0.212671f * r + 0.715160f * g + 0.072169f * b; }
  constexpr float max() const { return std::max(r, std::max(g, b)); }
  constexpr float min() const { return std::min(r, std::min(g, b)); }
  constexpr float average() const { return (r + g + b) * (1.0f / 3.0f); }
  constexpr Rgb clamped(float lo, float hi) const {
    return {std::clamp(r, lo, hi), std::clamp(g, lo, hi), std::clamp(b, lo, hi)};
  }
  /// Negative channels to 0: how PBRT treats reflectances at shading time.
  constexpr Rgb nonNegative() const { return {std::max(r, 0.0f), std::max(g, 0.0f), std::max(b, 0.0f)}; }
  friend std::ostream& operator<<(std::ostream& os, Rgb c) {
    return os << '[' << c.r << ' ' << c.g << ' ' << c.b << ']';
  }
};

inline Rgb exp(Rgb c) { return {std::exp(c.r), std::exp(c.g), std::exp(c.b)}; }
inline Rgb sqrt(Rgb c) { return {std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)}; }
constexpr Rgb lerp(float t, Rgb a, Rgb b) { return (1 - t) * a + t * b; }

}  // namespace pbrtmedia
