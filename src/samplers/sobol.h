// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/sampler.h"

namespace pbrtmedia {

/// Sampler "sobol": the first four dimensions of Sobol's sequence with nested uniform (Owen) scrambling,
/// padded. A 2D request opens a group with the first two dimensions, which are a (0, 2)-sequence in base 2;
/// single numbers after it take the third and fourth. Every group has its own shuffled index and
/// scrambling, per pixel (Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)). So every pair is
/// as good as the best one, and there is no limit to the dimensions.
class SobolSampler final : public Sampler {
 public:
  struct Params {
    std::int64_t pixelSamples = 16;  ///< >= 1; rounded up to a power of two
    std::uint64_t seed = 0;
  };
  /// Throws SceneError when pixelSamples is out of range.
  explicit SobolSampler(const Params& params);
  std::string_view typeName() const override { return "sobol"; }
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
  int next_ = 0;              ///< dimension of the group that the next single number takes
};

}  // namespace pbrtmedia
