// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/random.h"

#include "samplers/counts.h"
#include "samplers/keys.h"

namespace pbrtmedia {

RandomSampler::RandomSampler(const Params& params)
    : Sampler(checkedCount("random", "pixelsamples", params.pixelSamples, 1), params.seed) {}

std::unique_ptr<Sampler> RandomSampler::clone() const { return std::make_unique<RandomSampler>(*this); }

void RandomSampler::start(Point2i pixel, std::int64_t index) {
  state_ = hashCombine(pixelKey(seed(), pixel), static_cast<std::uint64_t>(index));
}

float RandomSampler::get1D() { return keyToUnit(mix64(state_ += kKeyStep)); }

Point2f RandomSampler::get2D() { return keyToSquare(mix64(state_ += kKeyStep)); }

void RandomSampler::get2DArray(std::span<Point2f> out) {
  const std::uint64_t key = mix64(state_ += kKeyStep);  // one slot, whatever the length
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = keyToSquare(subKey(key, i + 1));
}

}  // namespace pbrtmedia
