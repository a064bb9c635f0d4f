// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/base_two.h"
#include "samplers/sampler.h"

namespace pbrtmedia {

/// A padded sequence: dimensions come in groups of four. A 2D request opens a group with its first two
/// dimensions, single numbers after it take the third and fourth, and then open groups themselves. Every
/// group has its own shuffled index and key, per pixel. So there is no limit to the dimensions.
///
/// `Sequence` has as static functions
///   float value(int dimension, std::uint64_t index, std::uint64_t count, std::uint64_t key): one of the
///       dimensions 0 to 3 of a point, scrambled by `key`, where indices are taken in blocks of `count`;
///   Point2f arrayPoint(std::uint64_t index, std::uint64_t all, std::uint64_t key): a point of an array, of
///       which `all` are in a pixel.
template <class Sequence>
class GroupedSampler : public Sampler {
 public:
  void start(Point2i pixel, std::int64_t index) final {
    keyOfPixel_ = pixelKey(seed(), pixel);
    index_ = static_cast<std::uint64_t>(index);
    groups_ = 0;
    next_ = kGroupDimensions;
  }

  float get1D() final {
    if (next_ == kGroupDimensions) openGroup();
    const int dimension = next_++;
    return Sequence::value(dimension, groupIndex_, count_,
                           subKey(groupKey_, static_cast<std::uint64_t>(dimension) + 1));
  }

  Point2f get2D() final {
    openGroup();
    next_ = 2;
    return {Sequence::value(0, groupIndex_, count_, subKey(groupKey_, 1)),
            Sequence::value(1, groupIndex_, count_, subKey(groupKey_, 2))};
  }

  void get2DArray(std::span<Point2f> out) final {
    const std::uint64_t key = subKey(keyOfPixel_, ++groups_), first = index_ * out.size();
    next_ = kGroupDimensions;
    const std::uint64_t all = static_cast<std::uint64_t>(samplesPerPixel()) * out.size();
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = Sequence::arrayPoint(first + i, all, key);
  }

 protected:
  GroupedSampler(std::int64_t samplesPerPixel, std::uint64_t seed)
      : Sampler(samplesPerPixel, seed), count_(static_cast<std::uint32_t>(samplesPerPixel)) {}

 private:
  static constexpr int kGroupDimensions = 4;

  void openGroup() {
    groupKey_ = subKey(keyOfPixel_, ++groups_);
    if (index_ >> 32) groupKey_ = hashCombine(groupKey_, index_ >> 32);
    groupIndex_ = prefixShuffle(static_cast<std::uint32_t>(index_), count_, groupKey_);
    next_ = 0;
  }

  std::uint32_t count_;  ///< samplesPerPixel
  std::uint64_t keyOfPixel_ = 0, index_ = 0;
  std::uint64_t groupKey_ = 0;
  std::uint32_t groupIndex_ = 0;
  std::uint32_t groups_ = 0;  ///< opened in this sample
  int next_ = 0;              ///< dimension of the group that the next single number takes
};

}  // namespace pbrtmedia
