// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "base/rng.h"
#include "samplers/sampler.h"

namespace pbrtmedia {

/// Random numbers for the vertices of a path: the first vertices use the Sampler, the rest the Rng, so that
/// paths may be of any length while samplers have a limited number of good dimensions.
class PathSamples {
 public:
  /// The scene-language reference limits samplers to about 1000 dimensions, and low-discrepancy sets are of
  /// little use beyond some tens.
  static constexpr int kSampledVertices = 8;

  /// Of a path of whose vertices the first `sampledVertices` use the Sampler.
  PathSamples(Sampler& sampler, Rng& rng, int sampledVertices = kSampledVertices)
      : sampler_(sampler), rng_(rng), sampledVertices_(sampledVertices) {}
  void startVertex(int index) { fromSampler_ = index < sampledVertices_; }
  float get1D() { return fromSampler_ ? sampler_.get1D() : rng_.uniform(); }
  Point2f get2D() {
    if (fromSampler_) return sampler_.get2D();
    const float x = rng_.uniform();
    return {x, rng_.uniform()};
  }
  /// Resizes `out` to `n` points.
  void get2DArray(std::size_t n, std::vector<Point2f>& out) {
    out.resize(n);
    if (fromSampler_) return sampler_.get2DArray(out);
    for (Point2f& u : out) u = get2D();
  }

 private:
  Sampler& sampler_;
  Rng& rng_;
  int sampledVertices_;
  bool fromSampler_ = true;
};

}  // namespace pbrtmedia
