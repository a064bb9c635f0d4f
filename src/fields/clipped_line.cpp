// SPDX-License-Identifier: BSD-2-Clause
#include "fields/clipped_line.h"

#include <algorithm>
#include <cmath>

#include "base/bounds.h"

namespace pbrtmedia {
namespace {

/// Fields answer safely up to this many local units outside their box.
constexpr double kSlack = 0.25;

bool isNear(const Bounds3d& box, Vec3d p) {
  return p.x >= box.min.x - kSlack && p.x <= box.max.x + kSlack && p.y >= box.min.y - kSlack &&
         p.y <= box.max.y + kSlack && p.z >= box.min.z - kSlack && p.z <= box.max.z + kSlack;
}

/// Narrows [tMin, tMax] to the box; false when nothing is left. Random signs cost no branch here.
bool clipToSlabs(const Bounds3d& box, const LocalLine& line, double& tMin, double& tMax) {
  const auto clip = [&](double lo, double hi, double o, double inverse) {
    if (!(std::abs(inverse) < std::numeric_limits<double>::infinity())) return o >= lo && o <= hi;
    const double a = (lo - o) * inverse, b = (hi - o) * inverse;
    tMin = std::max(tMin, std::min(a, b));
    tMax = std::min(tMax, std::max(a, b));
    return true;
  };
  return clip(box.min.x, box.max.x, line.o.x, line.inverse.x) &&
         clip(box.min.y, box.max.y, line.o.y, line.inverse.y) &&
         clip(box.min.z, box.max.z, line.o.z, line.inverse.z) && tMin < tMax;
}

}  // namespace

std::optional<ClippedLine> ClippedLine::clip(const AffineMap& localFromWorld, const SuperVoxels& cells,
                                             const Segment& segment) {
  const Bounds3d& box = cells.occupied();
  if (!(segment.tMin < segment.tMax) || box.isEmpty()) return std::nullopt;
  LocalLine line;
  line.o = localFromWorld.point(Vec3d(segment.o));
  line.d = localFromWorld.vector(Vec3d(segment.d));
  line.inverse = {1 / line.d.x, 1 / line.d.y, 1 / line.d.z};
  double tMin = segment.tMin, tMax = segment.tMax;
  if (!clipToSlabs(box, line, tMin, tMax)) return std::nullopt;
  line.o = min(max(line.o + tMin * line.d, box.min), box.max);
  double length = tMax - tMin;
  // Far from the segment's origin t itself is coarse: then clip again from the entry, where it is not.
  if (!isNear(box, line.o + length * line.d)) {
    if (!isFinite(line.o) || !isFinite(line.d)) return std::nullopt;
    double begin = 0;
    clipToSlabs(box, line, begin, length);
  }
  // An infinite length is left only where the direction is zero: a point, not a line.
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  return ClippedLine(cells, line, length, tMin);
}

}  // namespace pbrtmedia
