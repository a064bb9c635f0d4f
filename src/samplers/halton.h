// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/sampler.h"

namespace pbrtmedia {

/// Sampler "halton": the Halton sequence in bases 2, 3, 5, 7 with nested digit scrambling, padded. Dimensions
/// come in groups: a 2D request opens a group with bases 2 and 3, single numbers after it take 5 and 7. Every
/// group has its own shuffled index and its own scrambling, per pixel. So there is no limit to the dimensions
/// and none of them suffers from a large base: at common sample counts a base above the count would be little
/// better than random. Any number of samples is good; powers of two are best.
class HaltonSampler final : public Sampler {
 public:
  struct Params {
    std::int64_t pixelSamples = 16;  ///< >= 1
    bool samplePixelCentre = false;  ///< film positions at pixel centres
    std::uint64_t seed = 0;
  };
  /// Throws SceneError when pixelSamples < 1.
  explicit HaltonSampler(const Params& params);
  std::string_view typeName() const override { return "halton"; }
  std::unique_ptr<Sampler> clone() const override;
  void start(Point2i pixel, std::int64_t index) override;
  float get1D() override;
  Point2f get2D() override;
  void get2DArray(std::span<Point2f> out) override;

 private:
  void openGroup();

  std::uint32_t count_;  ///< samplesPerPixel
  std::uint64_t keyOfPixel_ = 0, index_ = 0;
  std::uint64_t groupKey_ = 0;
  std::uint32_t groupIndex_ = 0;
  std::uint32_t groups_ = 0;  ///< opened in this sample
  int next_ = 0;              ///< base of the group that the next single number takes
};

}  // namespace pbrtmedia
