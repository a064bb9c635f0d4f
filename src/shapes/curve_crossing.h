// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "shapes/cubic_bezier.h"

namespace pbrtmedia {

/// A coordinate system in which a ray starts at the origin and runs along z; lengths are as outside.
struct RaySpace {
  Vec3d origin, x, y, z;  ///< x, y, z: unit, right-handed
  /// `direction`: unit; `along`: any, x lies on its side where it is not parallel to the ray.
  RaySpace(Vec3d rayOrigin, Vec3d direction, Vec3d along);
  Vec3d point(Vec3d p) const { return vector(p - origin); }
  Vec3d vector(Vec3d v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3d outside(Vec3d v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Finds where the z axis passes a curve within half its width, by halving the curve until it is nearly
/// straight. `Acceptor` knows widths and decides: `double widthAt(double u) const` (never more than
/// `maxWidth`), `double zMax() const` (what lies beyond is not looked for; may shrink) and
/// `void take(Vec3d spine, double u, double v)`, called for each crossing, in no certain order.
template <class Acceptor>
class CurveCrossing {
 public:
  CurveCrossing(Acceptor& acceptor, double maxWidth) : acceptor_(acceptor), half_(maxWidth / 2) {}

  /// `curve`: in ray space, over [u0, u1] of its segment; `flatness`: how far it may be from its chords.
  void find(const CubicBezier& curve, double u0, double u1, double flatness) {
    if (mayCross(curve)) halve(curve, u0, u1, curve.halvingsWithin(flatness));
  }

 private:
  void halve(const CubicBezier& curve, double u0, double u1, int halvings) {
    if (halvings == 0) return crossChord(curve, u0, u1);
    const auto [first, second] = curve.halves();
    const double middle = (u0 + u1) / 2;
    if (mayCross(first)) halve(first, u0, middle, halvings - 1);
    if (mayCross(second)) halve(second, middle, u1, halvings - 1);
  }

  /// The hull of the control points, grown by half the width, around the ray.
  bool mayCross(const CubicBezier& c) const {
    const Vec3d lo = min(min(c.p[0], c.p[1]), min(c.p[2], c.p[3]));
    const Vec3d hi = max(max(c.p[0], c.p[1]), max(c.p[2], c.p[3]));
    return lo.x <= half_ && hi.x >= -half_ && lo.y <= half_ && hi.y >= -half_ && hi.z >= -half_ &&
           lo.z <= acceptor_.zMax() + half_;
  }

  /// The piece lies between the lines across its ends; the axis is nearest to it where it is nearest to the
  /// chord.
  void crossChord(const CubicBezier& c, double u0, double u1) {
    const auto inPlane = [](Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y; };
    if (inPlane(c.p[0] - c.p[1], c.p[0]) < 0 || inPlane(c.p[3] - c.p[2], c.p[3]) < 0) return;
    const Vec3d chord = c.p[3] - c.p[0];
    const double squared = inPlane(chord, chord);
    if (!(squared > 0)) return;
    const double w = -inPlane(c.p[0], chord) / squared;
    const double u = std::clamp(lerp(w, u0, u1), u0, u1), width = acceptor_.widthAt(u);
    const double inside = std::clamp(w, 0.0, 1.0);
    const Vec3d spine = c.at(inside);
    const double distance = std::sqrt(inPlane(spine, spine));
    if (!(distance <= width / 2) || width == 0) return;
    const Vec3d along = c.derivative(inside);
    const double side = along.y * spine.x - along.x * spine.y;
    acceptor_.take(spine, u, 0.5 + (side > 0 ? distance : -distance) / width);
  }

  Acceptor& acceptor_;
  double half_;
};

}  // namespace pbrtmedia
