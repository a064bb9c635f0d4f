// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "fields/canonical_function.h"
#include "fields/density_line.h"

namespace pbrtmedia {

/// A canonical function laid along a segment, with bounds of our choice, true or not: what the lab, the
/// benchmarks and tests give to estimators. One type for every function, so that estimators are compiled
/// once.
///
/// The function sits at [offset, offset + length] of its axis and density(s) looks at the point offset + s in
/// double, so a large offset costs digits as it would in a scene. Densities and bounds are doubles, as the
/// integrals are: what they deviate from integral() by is a few roundings of double. The function must
/// outlive the line. Thread-safe once made, unless it records.
class CanonicalLine {
 public:
  static constexpr unsigned kNone = static_cast<unsigned>(-1);
  struct Setup {
    double length = 1;         ///< >= 0
    double offset = 0;         ///< of the segment's start
    double scale = 1;          ///< density = scale * function; > 0
    double control = 1;        ///< upper bound / largest density of the interval; > 0, below 1: not a bound
    double lower = 0;          ///< lower bound / smallest density of the interval; 0: none
    unsigned superVoxels = 1;  ///< intervals of equal length with their own bounds, >= 1
    bool hasMeans = true;      ///< intervals know their mean density
    double leastUpper = 0;     ///< upper bounds are raised to this density
    unsigned blind = kNone;    ///< the interval whose upper bound says 0, whatever lies there
    /// Above 0: lower bounds are this density in place of `lower`, as far as upper bounds allow, even where
    /// it is above the function.
    double lowerDensity = 0;
    double end = std::numeric_limits<double>::infinity();  ///< the segment is cut there; >= 0
  };
  struct Interval {
    double sEnter, sExit;
    DensityBounds<double> bound;
  };

  CanonicalLine(const CanonicalFunction& function, const Setup& setup);

  double length() const { return length_; }
  /// What lies between, restarted at sEnter, with the bounds of the intervals it meets; 0 <= sEnter < sExit
  /// <= length(). Looks are recorded as places on the whole.
  CanonicalLine stretch(double sEnter, double sExit) const;
  /// The bounds are known to be true unless the setup spoils them, by a control below 1, a lower bound above
  /// 1 or above the function, or a blind interval; or setUppers does.
  bool hasProvenBounds() const { return hasProvenBounds_; }
  double density(double s) const {
    const double whole = begin_ + s;
    if (record_ != nullptr) [[unlikely]] {
      record_->push_back(whole);
    }
    const double density = setup_.scale * (*function_)(((setup_.offset + whole) - setup_.offset) * toX_);
    if (clamps_) [[unlikely]] {
      return std::min(density, intervals_[intervalAt(s)].bound.upper);
    }
    return density;
  }
  void densities(std::span<const double> s, std::span<double> out) const { densitiesOneByOne(*this, s, out); }
  template <class Visit>
  void walk(Visit&& visit) const {
    for (const Interval& i : intervals_) {
      if (!visit(i.sEnter, i.sExit, i.bound)) return;
    }
  }
  /// Call only if isPiecewiseCubic().
  template <class Visit>
  void walkPieces(Visit&& visit) const {
    const std::span<const double> x = function_->knots();
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double enter = std::max(x[i - 1] / toX_ - begin_, 0.0),
                   exit = i + 1 < x.size() ? std::min(x[i] / toX_ - begin_, length()) : length();
      if (enter < exit && !visit(enter, exit)) return;
    }
  }
  bool isPiecewiseCubic() const { return function_->isPiecewisePolynomial(); }

  const CanonicalFunction& function() const { return *function_; }
  const Setup& setup() const { return setup_; }
  std::span<const Interval> intervals() const { return intervals_; }
  /// Exact integral of the density over the segment, unclamped.
  double integral() const {
    if (!(setup_.length > 0)) return 0;
    const double width = function_->width();
    const double of = length_ < setup_.length
                          ? function_->integral(begin_ * toX_, std::min((begin_ + length_) * toX_, width))
                          : function_->integral();
    return setup_.scale * of / width * setup_.length;
  }
  /// Integral of the upper bounds over the segment.
  double upperIntegral() const;
  /// Appends the s of every later look-up to `points`; null: no longer.
  void record(std::vector<double>* points) { record_ = points; }
  /// Other upper bounds, one for each interval, unproven; lower ones give way. With `clamps` the density is
  /// cut to them: what progressive null tracking sees. Not while somebody uses the line.
  void setUppers(std::span<const double> uppers, bool clamps);
  /// Number of the interval that holds s.
  std::size_t intervalAt(double s) const;

 private:
  /// Without intervals.
  CanonicalLine(const CanonicalLine& whole, double length, double begin);

  const CanonicalFunction* function_;
  Setup setup_;
  double toX_;     ///< x = s * toX_
  double length_;  ///< from begin_ on
  double begin_ = 0;
  bool hasProvenBounds_;
  std::vector<Interval> intervals_;
  std::vector<double>* record_ = nullptr;
  bool clamps_ = false;
};

static_assert(PiecewiseCubicLine<CanonicalLine>);

}  // namespace pbrtmedia
