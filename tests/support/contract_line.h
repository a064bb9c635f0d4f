// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fields/density_line.h"

namespace pbrtmedia::test {

/// A line of length 2 that holds what estimators meet: an empty stretch, a smooth cubic hill, a step, a ramp.
/// Piecewise cubic, so that regular tracking is exact on it. Counts how often its density is asked for.
/// Or nothing but vacuum, or no length. Bounds: one per piece, or one for all; tight ones times `looseness`.
class ContractLine {
 public:
  static constexpr bool hasProvenBounds() { return true; }
  static constexpr double kEmptyEnd = .3, kHillEnd = 1, kFlatEnd = 1.5, kEnd = 2;
  static constexpr double kFlat = .75, kRampBegin = 1.5, kRampEnd = .25, kHill = 8;
  static constexpr double kMaximum = 1.5;

  enum class Kind { Full, Vacuum, Point };

  explicit ContractLine(double looseness = 1, bool oneBound = false, double minorantShare = 1)
      : looseness_(looseness), oneBound_(oneBound), minorantShare_(minorantShare) {}
  explicit ContractLine(Kind kind) : ContractLine() { kind_ = kind; }

  /// Ends the line at s < kEnd.
  void cutAt(double s) { end_ = s; }
  double length() const { return kind_ == Kind::Point ? 0 : end_ - begin_; }
  /// Counted by the whole, which it borrows.
  ContractLine stretch(double sEnter, double sExit) const {
    ContractLine part = *this;
    part.begin_ = begin_ + sEnter;
    part.end_ = begin_ + sExit;
    part.whole_ = whole_ != nullptr ? whole_ : this;
    return part;
  }
  /// Out of line: where all of an estimator is inlined around it, GCC 12 warns of members of an empty
  /// optional.
  [[gnu::noinline]] float density(double along) const {
    ++(whole_ != nullptr ? whole_ : this)->asked_;
    const double s = begin_ + along;
    if (kind_ == Kind::Vacuum) return 0;
    if (s < kEmptyEnd) return 0;
    if (s < kHillEnd) return static_cast<float>(hill(s));
    if (s < kFlatEnd) return static_cast<float>(kFlat);
    return static_cast<float>(kRampBegin + (s - kFlatEnd) / (kEnd - kFlatEnd) * (kRampEnd - kRampBegin));
  }
  void densities(std::span<const double> s, std::span<float> out) const { densitiesOneByOne(*this, s, out); }
  template <class Visit>
  void walk(Visit&& visit) const {
    if (kind_ == Kind::Point) return;
    if (kind_ == Kind::Vacuum) {
      visit(0.0, length(), SuperVoxel{0, 0, 0});
      return;
    }
    if (oneBound_) {
      visit(0.0, length(), SuperVoxel{scaled(kMaximum), 0, static_cast<float>(integral() / kEnd)});
      return;
    }
    const double hillTop = .35 * .35 * kHill;  // above the cubic's maximum
    const struct {
      double exit, upper, lower, mean;
    } pieces[] = {{kEmptyEnd, 0, 0, 0},
                  {kHillEnd, hillTop, 0, hillIntegral() / (kHillEnd - kEmptyEnd)},
                  {kFlatEnd, kFlat, kFlat, kFlat},
                  {kEnd, kRampBegin, kRampEnd, (kRampBegin + kRampEnd) / 2}};
    double enter = 0;
    for (const auto& p : pieces) {
      if (p.exit <= begin_) continue;
      const SuperVoxel bound{scaled(p.upper), static_cast<float>(minorantShare_ * p.lower),
                             static_cast<float>(p.mean)};
      const double exit = std::min(p.exit, end_) - begin_;
      if (!visit(enter, exit, bound) || p.exit >= end_) return;
      enter = exit;
    }
  }
  template <class Visit>
  void walkPieces(Visit&& visit) const {
    if (kind_ != Kind::Full) return;
    double enter = kEmptyEnd;
    for (const double exit : {kHillEnd, kFlatEnd, kEnd}) {
      const double from = std::max(enter, begin_) - begin_, to = std::min(exit, end_) - begin_;
      enter = exit;
      if (from < to && !visit(from, to)) return;
    }
  }

  static double integral() { return hillIntegral() + kFlat * .5 + (kRampBegin + kRampEnd) / 2 * .5; }
  /// Integral of the density over [0, s].
  static double integralTo(double s) {
    double sum = 0;
    if (s > kEmptyEnd) {
      const double v = std::min(s, kHillEnd) - kEmptyEnd, w = kHillEnd - kEmptyEnd;
      // v (w - v) (.9 - v) = .9 w v - (w + .9) v^2 + v^3
      sum += kHill * v * v * (.9 * w / 2 - v * ((w + .9) / 3 - v / 4));
    }
    if (s > kHillEnd) sum += kFlat * (std::min(s, kFlatEnd) - kHillEnd);
    if (s > kFlatEnd) {
      const double v = s - kFlatEnd;
      sum += v * (kRampBegin + v * (kRampEnd - kRampBegin) / (2 * (kEnd - kFlatEnd)));
    }
    return sum;
  }
  std::uint64_t asked() const { return asked_; }

 private:
  /// kHill (s - .3)(1 - s) (1.2 - s) >= 0 on the hill's stretch: a cubic.
  static double hill(double s) { return kHill * (s - kEmptyEnd) * (kHillEnd - s) * (1.2 - s); }
  static double hillIntegral() {
    // With w = .7 and v = s - .3: 8 times the integral of v (w - v) (.9 - v) = .9 w^3/6 - w^4/12.
    constexpr double w = kHillEnd - kEmptyEnd;
    return kHill * (.9 * w * w * w / 6 - w * w * w * w / 12);
  }
  float scaled(double upper) const { return static_cast<float>(looseness_ * upper); }

  Kind kind_ = Kind::Full;
  double begin_ = 0, end_ = kEnd;
  const ContractLine* whole_ = nullptr;
  double looseness_;
  bool oneBound_;
  double minorantShare_;
  mutable std::uint64_t asked_ = 0;
};

}  // namespace pbrtmedia::test
