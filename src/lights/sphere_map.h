// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "base/distribution.h"
#include "lights/light_map.h"

namespace pbrtmedia {

/// Map coordinates of a direction (any length) whose pole is +z: u = atan2(y, x)/2π in [0, 1), v = θ/π in [0,
/// 1] with θ from +z. Accurate next to the poles, where acos is not.
Point2f latLong(Vector3f w);

/// A latitude-longitude picture around the origin, its pole (top row) at +z and its left edge at +x, and
/// directions sampled by it.
///
/// It is sampled cell by cell, a cell being the solid angle one texel covers; its probability is the integral
/// of the interpolated picture over the cell (channel mean, times the cell's solid angle), so it is positive
/// wherever the picture is. Inside a cell directions are uniform over solid angle, so the density is constant
/// there, also at the poles. Immutable, thread-safe.
class SphereMap {
 public:
  /// Errors: see LightMap.
  explicit SphereMap(const Image& image) : map_(image) {}
  /// Before `sample` and `pdf`: directions are sampled by `factor` times the picture.
  void prepareSampling(Rgb factor);

  struct Sample {
    Vector3f w;  ///< unit
    Rgb value;   ///< of the picture there
    float pdf;   ///< solid angle
  };
  Sample sample(Point2f u) const;
  /// Solid-angle density of `sample` at a direction of any length.
  float pdf(Vector3f w) const { return pdfAt(latLong(w)); }
  Rgb lookup(Vector3f w) const { return map_.lookup(latLong(w)); }
  /// Of the texels, whatever solid angle they cover.
  Rgb mean() const { return map_.mean(); }

 private:
  float pdfAt(Point2f uv) const;
  std::size_t rowOf(float v) const;

  LightMap map_;
  Distribution2D cells_;
  std::vector<double> sinSquaredHalf_;  ///< sin²(θ/2) at the height + 1 row borders
};

}  // namespace pbrtmedia
