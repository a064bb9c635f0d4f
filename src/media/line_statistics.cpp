// SPDX-License-Identifier: BSD-2-Clause
#include "media/line_statistics.h"

#include "base/rng.h"
#include "base/warp.h"
#include "media/control_density.h"

namespace pbrtmedia {

LineStatistics lineStatistics(const DensityKernel& kernel) {
  constexpr int kLines = 64, kMostPieces = 1000;
  LineStatistics sum{.pieces = 0};
  const Bounds3d& box = kernel.superVoxels().occupied();
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
    const Vec3d o = kernel.worldFromLocal().point(inside);
    const Vec3d d = kernel.worldFromLocal().vector(direction * (size.x + size.y + size.z));
    const auto line = kernel.clip({Point3f(o), Vector3f(d), -1, 1});
    if (!line) continue;
    ++lines;
    const double perT = length(d);
    line->walkCells([&](double sEnter, double sExit, const SuperVoxel& bound) {
      const double stretch = (sExit - sEnter) * perT;
      lower += stretch * static_cast<double>(bound.lower);
      upper += stretch * static_cast<double>(bound.upper);
      sum.column += bound.upper > 0 ? stretch * static_cast<double>(controlDensity(bound)) : 0;
      return true;
    });
    if (kernel.hasPieces()) sum.pieces += kernel.countPieces(*line, kMostPieces);
  }
  if (upper > 0) {
    sum.lowerShare = lower / upper;
    sum.meanShare = sum.column / upper;
  }
  if (lines > 0) {
    sum.pieces /= lines;
    sum.column /= lines;
  }
  if (!kernel.hasPieces()) sum.pieces = LineStatistics{}.pieces;
  return sum;
}

}  // namespace pbrtmedia
