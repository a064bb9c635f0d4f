// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <limits>
#include <type_traits>

#include "base/rng.h"
#include "base/warp.h"
#include "fields/field_line.h"
#include "fields/super_voxels.h"
#include "media/control_density.h"

namespace pbrtmedia {

/// What straight lines through a medium meet: means over some that cross it.
struct LineStatistics {
  /// Cubic pieces of the density on a line, counted up to 1000; infinite where it has none.
  double pieces = std::numeric_limits<double>::infinity();
  double column = 0;      ///< integral of the super-voxels' control densities, in world lengths
  double lowerShare = 0;  ///< integral of the lower bounds by that of the upper ones, in [0, 1]
  double meanShare = 0;   ///< the same of the mean densities
};

/// Deterministic. All 0 where nothing is occupied. Cost: walks along 64 lines, without a look-up.
template <class Field>
LineStatistics lineStatistics(const Field& field, const SuperVoxels& bounds) {
  constexpr int kLines = 64, kMostPieces = 1000;
  LineStatistics sum{.pieces = 0};
  const Bounds3d& box = bounds.occupied();
  if (box.isEmpty()) return sum;
  double lower = 0, upper = 0;
  int lines = 0;
  Rng rng(0x6c696e65);
  for (int i = 0; i < kLines; ++i) {
    const double u = rng.uniformDouble(), v = rng.uniformDouble(), w = rng.uniformDouble();
    const Vec3d size = box.max - box.min;
    const Vec3d inside = box.min + Vec3d{u * size.x, v * size.y, w * size.z};
    const float s = rng.uniform();
    const Vec3d direction(sampleUniformSphere({s, rng.uniform()}));
    const Vec3d o = field.worldFromLocal().point(inside);
    const Vec3d d = field.worldFromLocal().vector(direction * (size.x + size.y + size.z));
    const auto line = FieldLine<Field>::clip(field, bounds, {Point3f(o), Vector3f(d), -1, 1});
    if (!line) continue;
    ++lines;
    const double perT = length(d);
    line->walk([&](double sEnter, double sExit, const SuperVoxel& bound) {
      const double stretch = (sExit - sEnter) * perT;
      lower += stretch * static_cast<double>(bound.lower);
      upper += stretch * static_cast<double>(bound.upper);
      sum.column += bound.upper > 0 ? stretch * static_cast<double>(controlDensity(bound)) : 0;
      return true;
    });
    if constexpr (PiecewiseCubicField<Field>) {
      int pieces = 0;
      line->walkPieces([&](double, double) { return ++pieces < kMostPieces; });
      sum.pieces += pieces;
    }
  }
  if (upper > 0) {
    sum.lowerShare = lower / upper;
    sum.meanShare = sum.column / upper;
  }
  if (lines > 0) {
    sum.pieces /= lines;
    sum.column /= lines;
  }
  if (!PiecewiseCubicField<Field>) sum.pieces = LineStatistics{}.pieces;
  return sum;
}

}  // namespace pbrtmedia
