// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/sobol.h"

#include "samplers/base_two.h"
#include "samplers/counts.h"

namespace pbrtmedia {

float SobolSequence::value(int dimension, std::uint64_t index, std::uint64_t, std::uint64_t key) {
  return digitsToUnit(owenScramble(sobolDigits(static_cast<std::uint32_t>(index), dimension), key));
}

Point2f SobolSequence::arrayPoint(std::uint64_t index, std::uint64_t all, std::uint64_t key) {
  return scrambledZeroTwoRun(index, indexBits(all), key);
}

template class GroupedSampler<SobolSequence>;

SobolSampler::SobolSampler(const Params& params)
    : GroupedSampler(roundUpToPowerOfTwo(checkedCount("sobol", "pixelsamples", params.pixelSamples, 1)),
                     params.seed) {}

std::unique_ptr<Sampler> SobolSampler::clone() const { return std::make_unique<SobolSampler>(*this); }

}  // namespace pbrtmedia
