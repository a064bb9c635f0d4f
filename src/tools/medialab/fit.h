// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>

namespace pbrtmedia {

/// One point of a straight line in logarithms: y with its standard error at x; all > 0.
struct LogPoint {
  double x, y, error;
};

/// The slope of log y over log x by least squares with weights 1 / error^2, and its standard error, which
/// follows from the errors of the points alone. NaN for fewer than two usable points.
struct LogSlope {
  double slope, error;
};
LogSlope fitLogSlope(std::span<const LogPoint> points);

}  // namespace pbrtmedia
