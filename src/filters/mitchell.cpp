// SPDX-License-Identifier: BSD-2-Clause
#include "filters/mitchell.h"

#include "base/math.h"
#include "filters/check.h"

namespace pbrtmedia {
namespace {

/// Eq. (8) of the paper at t >= 0; support [0, 2]. In double: the cubics cancel near t = 1.
double piecewiseCubic(double t, double b, double c) {
  if (t >= 2) return 0;
  const double cubic =
      t <= 1 ? ((12 - 9 * b - 6 * c) * t + (-18 + 12 * b + 6 * c)) * t * t + (6 - 2 * b)
             : (((-b - 6 * c) * t + (6 * b + 30 * c)) * t - (12 * b + 48 * c)) * t + (8 * b + 24 * c);
  return cubic / 6;
}

}  // namespace

MitchellFilter::MitchellFilter(const Params& params)
    : Filter(checkedRadius("mitchell", params.radius)), b_(params.b), c_(params.c) {
  requireFilterParameter(std::isfinite(b_), "mitchell", "B", b_, "a finite number");
  requireFilterParameter(std::isfinite(c_), "mitchell", "C", c_, "a finite number");
}

float MitchellFilter::evaluate(Point2f p) const {
  return static_cast<float>(piecewiseCubic(2 * std::abs(p.x) / radius().x, b_, c_) *
                            piecewiseCubic(2 * std::abs(p.y) / radius().y, b_, c_));
}

}  // namespace pbrtmedia
