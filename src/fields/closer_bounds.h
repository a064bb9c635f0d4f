// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/interruption.h"
#include "fields/lattice_walk.h"
#include "fields/super_voxel.h"

namespace pbrtmedia {

/// A visitor of a walk without its type: where an indirect call is small against the rest.
class AnyVisit {
 public:
  template <class Visit>
  explicit AnyVisit(Visit& visit)
      : visit_(static_cast<void*>(std::addressof(visit))),
        call_([](void* v, double a, double b, const SuperVoxel& bound) {
          return static_cast<bool>((*static_cast<Visit*>(v))(a, b, bound));
        }) {}
  bool operator()(double sEnter, double sExit, const SuperVoxel& bound) const {
    return call_(visit_, sEnter, sExit, bound);
  }

 private:
  void* visit_;
  bool (*call_)(void*, double, double, const SuperVoxel&);
};

/// Halves a stretch of a line until bounds on each part are close: until `upper` times its length is at most
/// `column`, or `lower` is at least half of `upper`, so that every second tentative collision is real. Where
/// the stretch is as short as numbers can tell well, its density is that of its ends. So an extinction of
/// 1e20 costs as many parts as its logarithm, where a super-voxel's own bound would cost 1e20 null
/// collisions.
class CloserBounds {
 public:
  CloserBounds(double column, const AnyVisit& visit) : column_(column), visit_(visit) {}
  bool isClose(const SuperVoxel& bound, double length) const {
    return bound.upper * length <= column_ || (bound.lower > 0 && bound.upper <= 2 * bound.lower);
  }

 protected:
  bool visit(double a, double b, const SuperVoxel& bound) const {
    leaveIfAbandoned();
    return bound.upper > 0 ? visit_(a, b, bound) : visit_(a, b, SuperVoxel{0, 0, 0});
  }
  /// For the shortest stretches. With room for the rounding of other look-ups there.
  static SuperVoxel about(float density) {
    constexpr float kRoom = 1e-5f;
    return {density * (1 + kRoom), density * (1 - kRoom), density};
  }
  /// Whether a stretch is longer than numbers of its size, and coordinates of a cell of length `cell`, tell
  /// well apart. So tentative collisions on a stretch that is close by its column, 2^14 of them, always get
  /// on.
  static bool canHalve(double a, double b, double cell) {
    return b - a > kFinest * std::max({std::abs(a), std::abs(b), cell});
  }

 private:
  static constexpr double kFinest = 0x1p-36;  // 2^16 roundings
  double column_;
  const AnyVisit& visit_;
};

/// For fields that know the range of their density over stretches of a line (`rangeOn`). Parts lie on a
/// dyadic lattice of s that depends on nothing else, so flights over a shorter segment meet the same bounds.
template <class Field>
class RangedBounds : public CloserBounds {
 public:
  /// cellLength: of a super-voxel along the line, in the unit of s.
  RangedBounds(const Field& field, const LocalLine& line, double cellLength, double column,
               const AnyVisit& visit)
      : CloserBounds(column, visit),
        field_(field),
        line_(line),
        largest_(std::exp2(std::ceil(std::log2(cellLength)))) {}

  /// The stretch [sEnter, sExit] of a cell. False: the visitor has stopped.
  bool refine(double sEnter, double sExit, const SuperVoxel& cell) const {
    for (double a = std::floor(sEnter / largest_) * largest_; a < sExit; a += largest_) {
      if (!descend(a, largest_, sEnter, sExit, cell)) return false;
    }
    return true;
  }

 private:
  bool descend(double a, double size, double sEnter, double sExit, const SuperVoxel& cell) const {
    const double from = std::max(a, sEnter), to = std::min(a + size, sExit);
    if (!(from < to)) return true;
    SuperVoxel bound = field_.rangeOn(line_, a, a + size);
    bound.upper = std::min(bound.upper, cell.upper);
    bound.lower = std::min(std::max(bound.lower, cell.lower), bound.upper);
    bound.mean = (bound.lower + bound.upper) / 2;
    if (bound.upper > 0 && !canHalve(a, a + size, largest_)) {
      return visit(
          from, to,
          about(std::max(field_.density(line_.o + from * line_.d), field_.density(line_.o + to * line_.d))));
    }
    if (isClose(bound, size)) return visit(from, to, bound);
    const double half = size / 2;
    return descend(a, half, sEnter, sExit, cell) && descend(a + half, half, sEnter, sExit, cell);
  }

  const Field& field_;
  const LocalLine& line_;
  double largest_;
};

/// For densities that are cubic between the planes of a lattice (`walkPieces`): the coefficients of a cubic
/// in Bernstein's form enclose it, and are halved with it (de Casteljau).
template <class Field>
class CubicBounds : public CloserBounds {
 public:
  CubicBounds(const Field& field, const LocalLine& line, double column, const AnyVisit& visit)
      : CloserBounds(column, visit), field_(field), line_(line) {}

  bool refine(double sEnter, double sExit, const SuperVoxel& cell) const {
    bool more = true;
    field_.walkPieces(line_, sEnter, sExit,
                      [&](double a, double b) { return more = descend(a, b, pieceOn(a, b), cell, b - a); });
    return more;
  }

 private:
  using Coefficients = std::array<double, 4>;
  /// Rounding of look-ups in float, of the largest density around.
  static constexpr float kRounding = 4e-7f;

  Coefficients pieceOn(double a, double b) const {
    const double half = (b - a) / 2, middle = a + half;
    const auto at = [&](double t) {
      return static_cast<double>(field_.density(line_.o + (middle + t * half) * line_.d));
    };
    // Inside of the piece, away from rounding at its ends; even and odd parts through +-.3 and +-.9.
    const double v0 = at(-.9), v1 = at(-.3), v2 = at(.3), v3 = at(.9);
    const double evenInner = (v1 + v2) / 2, evenOuter = (v0 + v3) / 2;
    const double oddInner = (v2 - v1) / .6, oddOuter = (v3 - v0) / 1.8;
    const double c2 = (evenOuter - evenInner) / .72, c0 = evenInner - .09 * c2;
    const double c3 = (oddOuter - oddInner) / .72, c1 = oddInner - .09 * c3;
    return {c0 - c1 + c2 - c3, c0 - c1 / 3 - c2 / 3 + c3, c0 + c1 / 3 - c2 / 3 - c3, c0 + c1 + c2 + c3};
  }

  bool descend(double a, double b, const Coefficients& c, const SuperVoxel& cell, double piece) const {
    const auto [least, most] = std::minmax({c[0], c[1], c[2], c[3]});
    if (most == 0 && least == 0) return visit(a, b, SuperVoxel{0, 0, 0});
    // The cubic says when to stop; what is told leaves room for the rounding of look-ups, so that none is
    // above.
    const SuperVoxel cubic{static_cast<float>(most), static_cast<float>(least)};
    SuperVoxel bound;
    bound.upper = std::clamp(cubic.upper + kRounding * cell.upper, 0.0f, cell.upper);
    bound.lower = std::clamp(cubic.lower, std::min(cell.lower, bound.upper), bound.upper);
    bound.mean = (bound.lower + bound.upper) / 2;
    if (!canHalve(a, b, piece)) {
      return visit(
          a, b,
          about(std::max(field_.density(line_.o + a * line_.d), field_.density(line_.o + b * line_.d))));
    }
    if (isClose(cubic, b - a)) return visit(a, b, bound);
    const double middle = a + (b - a) / 2;
    const auto mean = [](double x, double y) { return x + (y - x) / 2; };
    const double c01 = mean(c[0], c[1]), c12 = mean(c[1], c[2]), c23 = mean(c[2], c[3]);
    const double left = mean(c01, c12), right = mean(c12, c23), peak = mean(left, right);
    return descend(a, middle, {c[0], c01, left, peak}, cell, piece) &&
           descend(middle, b, {peak, right, c23, c[3]}, cell, piece);
  }

  const Field& field_;
  const LocalLine& line_;
};

}  // namespace pbrtmedia
