// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/halton.h"

#include "samplers/base_two.h"
#include "samplers/counts.h"
#include "samplers/radical_inverse.h"

namespace pbrtmedia {
namespace {

constexpr int kGroupDimensions = 4;

/// Value of one dimension of a group; `count` indices are taken from a block.
float groupValue(int dimension, std::uint64_t index, std::uint64_t count, std::uint64_t key) {
  switch (dimension) {
    case 0:
      return digitsToUnit(owenScramble(static_cast<std::uint32_t>(index), key));
    case 1:
      return scrambledRadicalInverse<3>(index, count, key);
    case 2:
      return scrambledRadicalInverse<5>(index, count, key);
    default:
      return scrambledRadicalInverse<7>(index, count, key);
  }
}

}  // namespace

HaltonSampler::HaltonSampler(const Params& params)
    : Sampler(checkedCount("halton", "pixelsamples", params.pixelSamples, 1), params.seed),
      count_(static_cast<std::uint32_t>(samplesPerPixel())) {
  pinsPixelCentre_ = params.samplePixelCentre;
}

std::unique_ptr<Sampler> HaltonSampler::clone() const { return std::make_unique<HaltonSampler>(*this); }

void HaltonSampler::start(Point2i pixel, std::int64_t index) {
  keyOfPixel_ = pixelKey(seed(), pixel);
  index_ = static_cast<std::uint64_t>(index);
  groups_ = 0;
  next_ = kGroupDimensions;
}

void HaltonSampler::openGroup() {
  groupKey_ = subKey(keyOfPixel_, ++groups_);
  if (index_ >> 32) groupKey_ = hashCombine(groupKey_, index_ >> 32);
  groupIndex_ = prefixShuffle(static_cast<std::uint32_t>(index_), count_, groupKey_);
  next_ = 0;
}

float HaltonSampler::get1D() {
  if (next_ == kGroupDimensions) openGroup();
  const int dimension = next_++;
  return groupValue(dimension, groupIndex_, count_,
                    subKey(groupKey_, static_cast<std::uint64_t>(dimension) + 1));
}

Point2f HaltonSampler::get2D() {
  openGroup();
  next_ = 2;
  return {groupValue(0, groupIndex_, count_, subKey(groupKey_, 1)),
          groupValue(1, groupIndex_, count_, subKey(groupKey_, 2))};
}

void HaltonSampler::get2DArray(std::span<Point2f> out) {
  const std::uint64_t key = subKey(keyOfPixel_, ++groups_), first = index_ * out.size();
  next_ = kGroupDimensions;
  const std::uint64_t all = static_cast<std::uint64_t>(samplesPerPixel()) * out.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint64_t index = first + i;
    const std::uint64_t k = index >> 32 ? hashCombine(key, index >> 32) : key;
    const std::uint32_t shuffled = owenShuffle(static_cast<std::uint32_t>(index), indexBits(all), k);
    out[i] = {groupValue(0, shuffled, all, subKey(k, 1)), groupValue(1, shuffled, all, subKey(k, 2))};
  }
}

}  // namespace pbrtmedia
