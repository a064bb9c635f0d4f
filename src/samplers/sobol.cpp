// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/sobol.h"

#include "samplers/base_two.h"
#include "samplers/counts.h"

namespace pbrtmedia {
namespace {
constexpr int kGroupDimensions = 4;
}

SobolSampler::SobolSampler(const Params& params)
    : Sampler(roundUpToPowerOfTwo(checkedCount("sobol", "pixelsamples", params.pixelSamples, 1)),
              params.seed),
      count_(static_cast<std::uint32_t>(samplesPerPixel())) {}

std::unique_ptr<Sampler> SobolSampler::clone() const { return std::make_unique<SobolSampler>(*this); }

void SobolSampler::start(Point2i pixel, std::int64_t index) {
  keyOfPixel_ = pixelKey(seed(), pixel);
  index_ = static_cast<std::uint64_t>(index);
  groups_ = 0;
  next_ = kGroupDimensions;
}

void SobolSampler::openGroup() {
  groupKey_ = subKey(keyOfPixel_, ++groups_);
  if (index_ >> 32) groupKey_ = hashCombine(groupKey_, index_ >> 32);
  groupIndex_ = prefixShuffle(static_cast<std::uint32_t>(index_), count_, groupKey_);
  next_ = 0;
}

float SobolSampler::get1D() {
  if (next_ == kGroupDimensions) openGroup();
  const int dimension = next_++;
  return digitsToUnit(owenScramble(sobolDigits(groupIndex_, dimension),
                                   subKey(groupKey_, static_cast<std::uint64_t>(dimension) + 1)));
}

Point2f SobolSampler::get2D() {
  openGroup();
  next_ = 2;
  return {digitsToUnit(owenScramble(groupIndex_, subKey(groupKey_, 1))),
          digitsToUnit(owenScramble(sobolSecond(groupIndex_), subKey(groupKey_, 2)))};
}

void SobolSampler::get2DArray(std::span<Point2f> out) {
  const std::uint64_t key = subKey(keyOfPixel_, ++groups_), first = index_ * out.size();
  next_ = kGroupDimensions;
  const int all = indexBits(static_cast<std::uint64_t>(samplesPerPixel()) * out.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = scrambledZeroTwoRun(first + i, all, key);
}

}  // namespace pbrtmedia
