// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/halton.h"

#include "samplers/base_two.h"
#include "samplers/counts.h"
#include "samplers/radical_inverse.h"

namespace pbrtmedia {

float HaltonSequence::value(int dimension, std::uint64_t index, std::uint64_t count, std::uint64_t key) {
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

Point2f HaltonSequence::arrayPoint(std::uint64_t index, std::uint64_t all, std::uint64_t key) {
  const std::uint64_t k = index >> 32 ? hashCombine(key, index >> 32) : key;
  const std::uint32_t shuffled = owenShuffle(static_cast<std::uint32_t>(index), indexBits(all), k);
  return {value(0, shuffled, all, subKey(k, 1)), value(1, shuffled, all, subKey(k, 2))};
}

template class GroupedSampler<HaltonSequence>;

HaltonSampler::HaltonSampler(const Params& params)
    : GroupedSampler(checkedCount("halton", "pixelsamples", params.pixelSamples, 1), params.seed) {
  pinsPixelCentre_ = params.samplePixelCentre;
}

std::unique_ptr<Sampler> HaltonSampler::clone() const { return std::make_unique<HaltonSampler>(*this); }

}  // namespace pbrtmedia
