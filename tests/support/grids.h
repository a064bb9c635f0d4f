// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "base/rng.h"
#include "base/segment.h"
#include "base/warp.h"
#include "fields/grid_field.h"

namespace pbrtmedia::test {

/// A grid over the unit cube whose sample (i, j, k) is valueOf(i, j, k).
template <class ValueOf>
GridField::Params gridOf(int nx, int ny, int nz, GridBorder border, ValueOf&& valueOf) {
  GridField::Params params{nx, ny, nz, {}, {0, 0, 0}, {1, 1, 1}, border};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) params.density.push_back(valueOf(i, j, k));
    }
  }
  return params;
}

inline GridField::Params constantGrid(int n, GridBorder border, float value = 1) {
  return gridOf(n, n, n, border, [=](int, int, int) { return value; });
}

/// Samples over six decades, the given share of them 0.
inline GridField::Params randomGrid(int nx, int ny, int nz, GridBorder border, float emptyShare,
                                    std::uint64_t seed) {
  Rng rng(seed);
  return gridOf(nx, ny, nz, border, [&](int, int, int) {
    const float u = rng.uniform(), magnitude = rng.uniform();
    return u < emptyShare ? 0.0f : std::pow(10.0f, -6 * magnitude);
  });
}

/// A unit direction through a random point of the unit cube, starting `distance` before it.
inline Segment randomSegment(Rng& rng, float distance) {
  const Point3f through(rng.uniform(), rng.uniform(), rng.uniform());
  const Vector3f d = sampleUniformSphere({rng.uniform(), rng.uniform()});
  return {through - distance * d, d, 0, kInfinity};
}

}  // namespace pbrtmedia::test
