// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/fit.h"

#include <cmath>
#include <limits>

namespace pbrtmedia {

LogSlope fitLogSlope(std::span<const LogPoint> points) {
  double weights = 0, meanX = 0, meanY = 0;
  const auto isUsable = [](const LogPoint& p) {
    return p.x > 0 && p.y > 0 && p.error > 0 && std::isfinite(p.x) && std::isfinite(p.y) &&
           std::isfinite(p.error);
  };
  const auto weightOf = [](const LogPoint& p) { return (p.y / p.error) * (p.y / p.error); };
  for (const LogPoint& p : points) {
    if (!isUsable(p)) continue;
    const double w = weightOf(p);
    weights += w;
    meanX += w * std::log(p.x);
    meanY += w * std::log(p.y);
  }
  meanX /= weights;
  meanY /= weights;
  double xx = 0, xy = 0;
  for (const LogPoint& p : points) {
    if (!isUsable(p)) continue;
    const double w = weightOf(p), dx = std::log(p.x) - meanX;
    xx += w * dx * dx;
    xy += w * dx * (std::log(p.y) - meanY);
  }
  if (!(xx > 0)) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  return {xy / xx, 1 / std::sqrt(xx)};
}

}  // namespace pbrtmedia
