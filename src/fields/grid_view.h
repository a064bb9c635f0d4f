// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "fields/half_code.h"

namespace pbrtmedia {

/// The samples of a grid as look-ups see them: borrowed, in lattice units (sample i of an axis lies at i).
struct GridView {
  const float* floats = nullptr;                                ///< the samples, or null when they are halves
  const std::uint16_t* halves = nullptr;                        ///< HalfCode of sample / scale
  float scale = 1;                                              ///< of halves, a power of 2
  const std::int64_t *x = nullptr, *y = nullptr, *z = nullptr;  ///< place of a sample: x[i] + y[j] + z[k]
  std::int64_t row = 0, slice = 0;            ///< from a sample of a cell to those next in y, z
  bool bricked = false;                       ///< fields/sample_layout.h
  std::int64_t brickRow = 0, brickSlice = 0;  ///< bricks from one y, z to the next

  /// Trilinear interpolation at p, 0 <= p < samples - 1 per axis. The order of operations (y, z, then x) is
  /// that of the batch, which holds two neighbours in x in one 64-bit lane.
  float density(Vec3d p) const {
    // Coordinates are positive, so truncation is floor.
    const auto ix = static_cast<std::int64_t>(p.x), iy = static_cast<std::int64_t>(p.y),
               iz = static_cast<std::int64_t>(p.z);
    const float fx = static_cast<float>(p.x - static_cast<double>(ix)),
                fy = static_cast<float>(p.y - static_cast<double>(iy)),
                fz = static_cast<float>(p.z - static_cast<double>(iz));
    const std::int64_t at = x[ix] + y[iy] + z[iz];
    return floats ? interpolate(floats + at, fx, fy, fz) : scale * interpolate(halves + at, fx, fy, fz);
  }
  /// Value of a stored sample.
  float sample(std::int64_t at) const { return floats ? floats[at] : scale * HalfCode::decode(halves[at]); }

 private:
  static float value(float v) { return v; }
  static float value(std::uint16_t code) { return HalfCode::decode(code); }
  static float mix(float f, float a, float b) { return a + f * (b - a); }

  template <class T>
  float interpolate(const T* s, float fx, float fy, float fz) const {
    const T* const r = s + slice;
    const float a = mix(fz, mix(fy, value(s[0]), value(s[row])), mix(fy, value(r[0]), value(r[row])));
    const float b = mix(fz, mix(fy, value(s[1]), value(s[row + 1])), mix(fy, value(r[1]), value(r[row + 1])));
    return mix(fx, a, b);
  }
};

}  // namespace pbrtmedia
