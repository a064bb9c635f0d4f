// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/stratified.h"

#include <cmath>

#include "samplers/counts.h"
#include "samplers/keys.h"

namespace pbrtmedia {
namespace {

constexpr std::int64_t kMaxPerAxis = 1 << 15;  // so that a round has at most 2^30 samples
constexpr std::uint64_t kMaxPattern = std::uint64_t{1}
                                      << 31;  // points of an array that are stratified together

std::uint32_t perAxis(const char* name, int value) {
  return static_cast<std::uint32_t>(checkedCount("stratified", name, value, 1, kMaxPerAxis));
}

float inStratum(std::uint32_t stratum, std::uint32_t count, float u) {
  return std::min((static_cast<float>(stratum) + u) / static_cast<float>(count), kOneMinusEpsilon);
}

/// The largest divisor of n that is not above its square root.
std::uint32_t nearSquareDivisor(std::uint32_t n) {
  std::uint32_t d = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(n)));
  while (n % d != 0) --d;
  return d;
}

}  // namespace

StratifiedSampler::StratifiedSampler(const Params& params)
    : Sampler(std::int64_t{perAxis("xsamples", params.xSamples)} * perAxis("ysamples", params.ySamples),
              params.seed),
      xSamples_(static_cast<std::uint32_t>(params.xSamples)),
      ySamples_(static_cast<std::uint32_t>(params.ySamples)),
      jitter_(params.jitter),
      dimensions_(static_cast<int>(checkedCount("stratified", "dimensions", params.dimensions, 0))),
      order_(xSamples_ * ySamples_) {}

std::unique_ptr<Sampler> StratifiedSampler::clone() const {
  return std::make_unique<StratifiedSampler>(*this);
}

void StratifiedSampler::start(Point2i pixel, std::int64_t index) {
  const std::uint64_t i = static_cast<std::uint64_t>(index), round = i / order_.size();
  inRound_ = static_cast<std::uint32_t>(i % order_.size());
  roundKey_ = hashCombine(pixelKey(seed(), pixel), round);
  slot_ = 0;
  used1D_ = used2D_ = 0;
}

float StratifiedSampler::get1D() {
  const std::uint64_t key = subKey(roundKey_, ++slot_);
  const float u = keyToUnit(hashCombine(key, inRound_));
  if (used1D_ >= dimensions_) return u;
  ++used1D_;
  return inStratum(order_(inRound_, key), order_.size(), jitter_ ? u : 0.5f);
}

Point2f StratifiedSampler::get2D() {
  const std::uint64_t key = subKey(roundKey_, ++slot_);
  const Point2f u = keyToSquare(hashCombine(key, inRound_));
  if (used2D_ >= dimensions_) return u;
  ++used2D_;
  const std::uint32_t cell = order_(inRound_, key);
  const Point2f inCell = jitter_ ? u : Point2f{0.5f, 0.5f};
  return {inStratum(cell % xSamples_, xSamples_, inCell.x), inStratum(cell / xSamples_, ySamples_, inCell.y)};
}

void StratifiedSampler::get2DArray(std::span<Point2f> out) {
  const std::uint64_t key = subKey(roundKey_, ++slot_), all = std::uint64_t{order_.size()} * out.size();
  if (all > kMaxPattern) {  // more points than any grid can order: the grid would be finer than floats
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = keyToSquare(hashCombine(key, inRound_, i));
    return;
  }
  if (out.empty()) return;
  const auto n = static_cast<std::uint32_t>(out.size());
  const std::uint32_t divisor = nearSquareDivisor(n);
  const std::uint32_t columns = xSamples_ * divisor, rows = ySamples_ * (n / divisor);
  const HashedPermutation order(columns * rows);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t point = inRound_ * n + i, cell = order(point, key);
    const Point2f u = jitter_ ? keyToSquare(hashCombine(key, point)) : Point2f{0.5f, 0.5f};
    out[i] = {inStratum(cell % columns, columns, u.x), inStratum(cell / columns, rows, u.y)};
  }
}

}  // namespace pbrtmedia
