// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/sampler.h"

namespace pbrtmedia {

/// Sampler "random": independent uniform numbers. Value number d of a sample is a hash of (seed, pixel,
/// index, d), so nothing is carried from one to the next.
class RandomSampler final : public Sampler {
 public:
  struct Params {
    std::int64_t pixelSamples = 4;  ///< >= 1
    std::uint64_t seed = 0;
  };
  /// Throws SceneError when pixelSamples < 1.
  explicit RandomSampler(const Params& params);
  std::string_view typeName() const override { return "random"; }
  std::unique_ptr<Sampler> clone() const override;
  bool isExtensible() const override { return true; }
  void start(Point2i pixel, std::int64_t index) override;
  float get1D() override;
  Point2f get2D() override;
  void get2DArray(std::span<Point2f> out) override;

 private:
  std::uint64_t state_ = 0;
};

}  // namespace pbrtmedia
