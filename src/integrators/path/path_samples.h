// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "render/sample_context.h"

namespace pbrtmedia {

/// Random numbers for the vertices of a path: the first vertices use the Sampler, the rest the Rng, so that
/// paths may be of any length while samplers have a limited number of good dimensions.
class PathSamples {
 public:
  /// The scene-language reference limits samplers to about 1000 dimensions, and low-discrepancy sets are of
  /// little use beyond some tens.
  static constexpr int kSampledVertices = 8;

  explicit PathSamples(SampleContext& context) : context_(context) {}
  void startVertex(int index) { fromSampler_ = index < kSampledVertices; }
  float get1D() { return fromSampler_ ? context_.sampler.get1D() : context_.rng.uniform(); }
  Point2f get2D() {
    if (fromSampler_) return context_.sampler.get2D();
    const float x = context_.rng.uniform();
    return {x, context_.rng.uniform()};
  }
  /// Resizes `out` to `n` points.
  void get2DArray(std::size_t n, std::vector<Point2f>& out) {
    out.resize(n);
    if (fromSampler_) return context_.sampler.get2DArray(out);
    for (Point2f& u : out) u = get2D();
  }

 private:
  SampleContext& context_;
  bool fromSampler_ = true;
};

}  // namespace pbrtmedia
