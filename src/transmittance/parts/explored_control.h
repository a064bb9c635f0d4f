// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "transmittance/estimate.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/bounded_lookup.h"

namespace pbrtmedia {

/// A density interpolated linearly between look-ups at fixed, equidistant points ("explorers") of a line,
/// both ends included; one explorer: the middle, constant; none: 0. Where bounds leave nothing open (upper =
/// lower) the explorer knows without looking. Lives on the stack of one estimate.
class ExploredControl {
 public:
  static constexpr std::size_t kMost = 256;

  /// A stretch on which the interpolation is linear, from `enter` at a to `exit` at b.
  struct Stretch {
    double a, b, enter, exit;

    /// The interpolation at s, kept within what the bounds allow.
    double at(double s, double lower, double upper) const {
      const double t = std::clamp((s - a) / (b - a), 0.0, 1.0);
      return std::clamp(enter + (exit - enter) * t, lower, upper);
    }
    /// Integral of at() from a to b.
    double integral(double lower, double upper) const {
      const double low = std::clamp(enter, lower, upper), high = std::clamp(exit, lower, upper);
      if (low == high) return (b - a) * low;
      // The clamped line is low until t0, straight until t1, then high.
      const double slope = exit - enter;
      const double t0 = (low - enter) / slope, t1 = (high - enter) / slope;
      return (b - a) * (t0 * low + (t1 - t0) * (low + high) / 2 + (1 - t1) * high);
    }
  };

  /// count <= kMost; the line has a length.
  template <DensityLine Line>
  ExploredControl(const Line& line, const BoundProfile& profile, std::size_t count, LookupTally& tally)
      : count_(std::min(count, kMost)), length_(profile.length()) {
    auto piece = profile.pieces().begin();
    for (std::size_t i = 0; i < count_; ++i) {
      const double s = position(i);
      while (piece + 1 != profile.pieces().end() && s > piece->sExit) ++piece;
      values_[i] =
          piece->upper > piece->lower ? boundedLookup(line, s, piece->upper, tally) : double{piece->upper};
    }
  }

  /// How far the inner explorers lie off the line through their two neighbours, at most: a cautious guess at
  /// the error of the interpolation. Infinite with fewer than three explorers.
  double largestError() const {
    if (count_ < 3) return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (std::size_t i = 1; i + 1 < count_; ++i) {
      largest = std::max(largest, std::abs(values_[i] - (values_[i - 1] + values_[i + 1]) / 2));
    }
    return largest;
  }

  /// Calls visit(stretch) for the linear stretches of [sEnter, sExit], in order, until it answers false;
  /// answers whether it never did.
  template <class Visit>
  bool stretches(double sEnter, double sExit, Visit&& visit) const {
    if (count_ < 2) {
      const double constant = count_ == 1 ? values_[0] : 0;
      return visit(Stretch{sEnter, sExit, constant, constant});
    }
    const double spacing = position(1);
    auto i = static_cast<std::size_t>(
        std::clamp(std::floor(sEnter / spacing), 0.0, static_cast<double>(count_ - 2)));
    for (double a = sEnter; a < sExit; ++i) {
      const bool isLast = i + 2 >= count_;
      const double knot = isLast ? length_ : position(i + 1), b = isLast ? sExit : std::min(knot, sExit);
      if (!(b > a)) continue;  // the entry is on the knot, to rounding
      const double begin = position(i), slope = (values_[i + 1] - values_[i]) / (knot - begin);
      if (!visit(Stretch{a, b, values_[i] + slope * (a - begin), values_[i] + slope * (b - begin)}))
        return false;
      a = b;
    }
    return true;
  }

 private:
  double position(std::size_t i) const {
    if (count_ == 1) return length_ / 2;
    return length_ * (static_cast<double>(i) / static_cast<double>(count_ - 1));
  }

  std::array<double, kMost> values_;
  std::size_t count_;
  double length_;
};

}  // namespace pbrtmedia
