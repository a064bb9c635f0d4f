// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/zero_two.h"

#include "samplers/base_two.h"
#include "samplers/counts.h"

namespace pbrtmedia {

ZeroTwoSampler::ZeroTwoSampler(const Params& params)
    : Sampler(roundUpToPowerOfTwo(checkedCount("02sequence", "pixelsamples", params.pixelSamples, 1)),
              params.seed),
      count_(static_cast<std::uint32_t>(samplesPerPixel())),
      dimensions_(static_cast<int>(checkedCount("02sequence", "dimensions", params.dimensions, 0))) {}

std::unique_ptr<Sampler> ZeroTwoSampler::clone() const { return std::make_unique<ZeroTwoSampler>(*this); }

void ZeroTwoSampler::start(Point2i pixel, std::int64_t index) { slots_.start(seed(), pixel, index); }

float ZeroTwoSampler::get1D() { return slots_.next1D(count_, dimensions_); }

Point2f ZeroTwoSampler::get2D() { return slots_.next2D(count_, dimensions_); }

void ZeroTwoSampler::get2DArray(std::span<Point2f> out) { slots_.next2DArray(count_, out); }

}  // namespace pbrtmedia
