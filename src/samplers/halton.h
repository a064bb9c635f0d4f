// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/grouped_sampler.h"

namespace pbrtmedia {

/// Dimensions 0 to 3; see GroupedSampler.
struct HaltonSequence {
  static float value(int dimension, std::uint64_t index, std::uint64_t count, std::uint64_t key);
  static Point2f arrayPoint(std::uint64_t index, std::uint64_t all, std::uint64_t key);
};

extern template class GroupedSampler<HaltonSequence>;

/// Sampler "halton": the Halton sequence in bases 2, 3, 5, 7 with nested digit scrambling, padded. Dimensions
/// come in groups: a 2D request opens a group with bases 2 and 3, single numbers after it take 5 and 7. Every
/// group has its own shuffled index and its own scrambling, per pixel. So there is no limit to the dimensions
/// and none of them suffers from a large base: at common sample counts a base above the count would be little
/// better than random. Any number of samples is good; powers of two are best.
class HaltonSampler final : public GroupedSampler<HaltonSequence> {
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
};

}  // namespace pbrtmedia
