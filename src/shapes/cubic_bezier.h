// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "base/vec.h"

namespace pbrtmedia {

/// A cubic in Bernstein form over [0, 1].
struct CubicBezier {
  std::array<Vec3d, 4> p;

  Vec3d at(double u) const;
  /// d at / du.
  Vec3d derivative(double u) const;
  /// The same curve over [0, 1/2] and over [1/2, 1], each with a parameter of its own.
  std::pair<CubicBezier, CubicBezier> halves() const;
  /// The part over [u0, u1], with a parameter of its own.
  CubicBezier part(double u0, double u1) const;
  /// Within twice `maxDistance` of its chords after so many halvings, at most 10; the estimate of PBRT-v3.
  int halvingsWithin(double maxDistance) const;
};

enum class CurveBasis : std::uint8_t { Bezier, BSpline };

/// Segments of a curve of degree 2 or 3: Bézier (neighbours share an end) or uniform B-spline. 0 when
/// `points` control points make no such curve.
std::size_t curveSegmentCount(std::size_t points, int degree, CurveBasis basis);
/// Segment `segment` < curveSegmentCount as a cubic.
CubicBezier curveSegment(std::span<const Point3f> points, std::size_t segment, int degree, CurveBasis basis);

}  // namespace pbrtmedia
