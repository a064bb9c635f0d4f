// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/vec.h"

namespace pbrtmedia {

/// Distances along o + t d, tMin <= t <= tMax (which may be infinite), with density proportional to 1/r², r
/// being the distance from a point such as a light: uniform in the angle that the point sees. Kulla & Fajardo
/// 2012, doi:10.1111/j.1467-8659.2012.03148.x, Section 4.1.
///
/// Their angles from the foot of the perpendicular lose all digits where the stretch is far away and seen
/// under a small angle; here the angle is measured from its near end, so no two large numbers are subtracted.
/// A point on the line itself, or so near that floats cannot tell, is taken as if it were kLeastDistance away
/// (relative to the largest coordinate): the density stays finite, and sampling with it stays unbiased.
class Equiangular {
 public:
  /// Relative distance below which single-precision points cannot say how far from the line they are.
  static constexpr double kLeastDistance = 0x1p-23;

  /// `d`: any length but 0. `tMin`: finite. Nothing when the stretch is empty or not finite where it must be.
  static std::optional<Equiangular> over(Vec3d o, Vec3d d, double tMin, double tMax, Vec3d point) {
    const double dd = dot(d, d);
    if (!(tMin < tMax) || !std::isfinite(tMin) || !(dd > 0)) return std::nullopt;
    Equiangular e;
    const double foot = dot(point - o, d) / dd;
    const Vec3d offset = o + foot * d - point;
    const double least = kLeastDistance * std::max(maxComponent(abs(o)), maxComponent(abs(point)));
    // In units of t, as the foot is.
    e.distance_ = std::max({std::sqrt(lengthSquared(offset)), least, kTiny}) / std::sqrt(dd);
    e.foot_ = foot;
    e.near_ = tMin - foot;
    e.tMin_ = tMin;
    e.tMax_ = tMax;
    const double far = tMax - foot, h = e.distance_;
    e.angle_ =
        std::isinf(tMax) ? std::atan2(h, e.near_) : std::atan2(h * (tMax - tMin), h * h + e.near_ * far);
    if (!(e.angle_ > 0) || !std::isfinite(e.near_)) return std::nullopt;
    return e;
  }

  /// `u` in [0, 1).
  double sample(double u) const {
    const double phi = u * angle_;
    return at(std::sin(phi), std::cos(phi));
  }
  /// Calls visit(t) for `n` distances in order that share the density evenly: those of u = (i + 1/2) / n, up
  /// to rounding.
  template <class Visit>
  void forEven(int n, const Visit& visit) const {
    const double half = angle_ / (2 * n);
    double sine = std::sin(half), cosine = std::cos(half);
    const double sineOfStep = 2 * sine * cosine, cosineOfStep = (cosine - sine) * (cosine + sine);
    for (int i = 0; i < n; ++i) {
      visit(at(sine, cosine));
      const double next = cosine * cosineOfStep - sine * sineOfStep;
      sine = sine * cosineOfStep + cosine * sineOfStep;
      cosine = next;
    }
  }
  /// Density with respect to t; 0 outside the stretch.
  double pdf(double t) const {
    if (!(t >= tMin_ && t <= tMax_)) return 0;
    const double s = t - foot_;
    return distance_ / (angle_ * (distance_ * distance_ + s * s));
  }
  /// The angle under which the point sees the stretch, times 1/distance: the integral of 1/r² over it.
  double strength() const { return angle_ / distance_; }

 private:
  static constexpr double kTiny = 1e-150, kHuge = 1e150;
  Equiangular() = default;
  /// Behind an angle from the near end.
  double at(double sine, double cosine) const {
    const double h = distance_;
    const double t = tMin_ + sine * (h * h + near_ * near_) / (h * cosine - near_ * sine);
    // Rounding at the far end of an infinite stretch: NaN and infinity become finite.
    return t >= tMin_ ? std::min(t, std::min(tMax_, kHuge)) : std::min(tMax_, kHuge);
  }
  double foot_ = 0, near_ = 0;  ///< t of the foot of the perpendicular; tMin relative to it
  double distance_ = 1;         ///< from the point to the line
  double tMin_ = 0, tMax_ = 0, angle_ = 0;
};

}  // namespace pbrtmedia
