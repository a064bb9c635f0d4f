// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/max_min_dist.h"

#include <algorithm>

#include "samplers/counts.h"
#include "samplers/lattice.h"

namespace pbrtmedia {
namespace {

constexpr int kMaxLatticeBits = std::countr_zero(MaxMinDistSampler::kMaxPoints);

/// Point `index` of the lattice in van der Corput order; every further round through it has its own random
/// shift and mirroring, so that the average over keys is uniform. Distances on the torus stay what they are.
Point2f latticePoint(std::uint64_t index, int bits, std::uint32_t multiplier, std::uint64_t key) {
  const std::uint64_t round = index >> bits;
  if (round != 0) key = hashCombine(key, round);
  const std::uint32_t order = static_cast<std::uint32_t>(index & ((std::uint64_t{1} << bits) - 1));
  // Coordinates as 32-bit fractions: reversing the index divides it by the number of points in this order,
  // and products with the multiplier wrap at 1 by themselves.
  std::uint32_t x = reverseBits(order), y = x * multiplier;
  const std::uint64_t shift = subKey(key, 1);
  if (key & 1) std::swap(x, y);
  if (key & 2) x = 0u - x;
  x += static_cast<std::uint32_t>(shift);
  y += static_cast<std::uint32_t>(shift >> 32);
  return {unitFloat(x), unitFloat(y)};
}

}  // namespace

MaxMinDistSampler::MaxMinDistSampler(const Params& params)
    : Sampler(roundUpToPowerOfTwo(checkedCount("maxmindist", "pixelsamples", params.pixelSamples, 1)),
              params.seed),
      count_(static_cast<std::uint32_t>(samplesPerPixel())),
      dimensions_(static_cast<int>(checkedCount("maxmindist", "dimensions", params.dimensions, 0))),
      latticeBits_(std::min(indexBits(count_), kMaxLatticeBits)),
      multiplier_(maxMinDistMultiplier(1u << latticeBits_)) {}

std::unique_ptr<Sampler> MaxMinDistSampler::clone() const {
  return std::make_unique<MaxMinDistSampler>(*this);
}

void MaxMinDistSampler::start(Point2i pixel, std::int64_t index) { slots_.start(seed(), pixel, index); }

float MaxMinDistSampler::get1D() { return slots_.next1D(count_, dimensions_); }

Point2f MaxMinDistSampler::get2D() {
  if (slots_.used2D() > 0 || dimensions_ == 0) return slots_.next2D(count_, dimensions_);
  return latticePoint(slots_.index(), latticeBits_, multiplier_, slots_.take2D());
}

void MaxMinDistSampler::get2DArray(std::span<Point2f> out) { slots_.next2DArray(count_, out); }

}  // namespace pbrtmedia
