// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/grouped_sampler.h"

namespace pbrtmedia {

/// Dimensions 0 to 3; see GroupedSampler.
struct SobolSequence {
  static float value(int dimension, std::uint64_t index, std::uint64_t count, std::uint64_t key);
  static Point2f arrayPoint(std::uint64_t index, std::uint64_t all, std::uint64_t key);
};

extern template class GroupedSampler<SobolSequence>;

/// Sampler "sobol": the first four dimensions of Sobol's sequence with nested uniform (Owen) scrambling,
/// padded. A 2D request opens a group with the first two dimensions, which are a (0, 2)-sequence in base 2;
/// single numbers after it take the third and fourth. Every group has its own shuffled index and
/// scrambling, per pixel (Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)). So every pair is
/// as good as the best one, and there is no limit to the dimensions.
class SobolSampler final : public GroupedSampler<SobolSequence> {
 public:
  struct Params {
    std::int64_t pixelSamples = 16;  ///< >= 1; rounded up to a power of two
    std::uint64_t seed = 0;
  };
  /// Throws SceneError when pixelSamples is out of range.
  explicit SobolSampler(const Params& params);
  std::string_view typeName() const override { return "sobol"; }
  std::unique_ptr<Sampler> clone() const override;
};

}  // namespace pbrtmedia
