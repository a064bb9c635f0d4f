// SPDX-License-Identifier: BSD-2-Clause
#include "film/layer_sums.h"

#include <algorithm>

namespace pbrtmedia {
namespace {

// Of the variance's sums: w² L² and w² L of three channels each, w² and w³.
constexpr std::size_t kSquares = 0, kProducts = 3, kWeight2 = 6, kWeight3 = 7;

void addVariance(Rgb radiance, double weight, double* sums) {
  const double weight2 = weight * weight;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto value = static_cast<double>(radiance[c]);
    sums[kSquares + c] += weight2 * value * value;
    sums[kProducts + c] += weight2 * value;
  }
  sums[kWeight2] += weight2;
  sums[kWeight3] += weight2 * weight;
}

/// Of one channel, unscaled.
double varianceOfMean(const double* sums, std::size_t c, double sum, double weight) {
  if (weight == 0) return 0;
  const double mean = sum / weight, weight2 = sums[kWeight2] / (weight * weight);
  const double share = 1 - 2 * sums[kWeight3] / (weight * sums[kWeight2]) + weight2;
  constexpr double kLeastShare = 1e-9;  // one sample, or all but one of no weight
  if (!(share > kLeastShare)) return 0;
  const double squares = sums[kSquares + c] - 2 * mean * sums[kProducts + c] + mean * mean * sums[kWeight2];
  return std::max(0.0, squares) / (weight * weight) / share;
}

}  // namespace

void addFiltered(const LayerSet& set, const float* sample, Rgb radiance, double weight, double* sums) {
  for (const Layer layer : set.layers()) {
    const LayerInfo& info = infoOf(layer);
    const std::size_t channels = info.channelCount();
    switch (info.kind) {
      case LayerKind::Mean:
      case LayerKind::Radiance:
        for (std::size_t c = 0; c < channels; ++c) sums[c] += weight * static_cast<double>(sample[c]);
        break;
      case LayerKind::Weighted: {
        const double own = weight * static_cast<double>(sample[channels]);
        for (std::size_t c = 0; c < channels; ++c) sums[c] += own * static_cast<double>(sample[c]);
        sums[channels] += own;
        break;
      }
      case LayerKind::Total:
        break;
      case LayerKind::Variance:
        addVariance(radiance, weight, sums);
        break;
    }
    sample += info.sampleSize();
    sums += info.sumCount();
  }
}

void addOwn(const LayerSet& set, const float* sample, double* sums) {
  for (const Layer layer : set.layers()) {
    const LayerInfo& info = infoOf(layer);
    if (info.kind == LayerKind::Total) *sums += static_cast<double>(*sample);
    sample += info.sampleSize();
    sums += info.sumCount();
  }
}

void developLayers(const LayerSet& set, std::span<const double> all, const WeightedSums& colour,
                   const SplatSum& splatVariance, const Development& development, float* out) {
  const double* sums = all.data();
  const auto scale = static_cast<double>(development.scale);
  const auto ratio = [](double sum, double weight) { return weight != 0 ? sum / weight : 0; };
  for (const Layer layer : set.layers()) {
    const LayerInfo& info = infoOf(layer);
    for (std::size_t c = 0; c < info.channelCount(); ++c, ++out) {
      switch (info.kind) {
        case LayerKind::Mean:
          *out = static_cast<float>(ratio(sums[c], colour.weight));
          break;
        case LayerKind::Radiance:
          *out = static_cast<float>(ratio(sums[c], colour.weight) * scale);
          break;
        case LayerKind::Weighted:
          *out = static_cast<float>(ratio(sums[c], sums[info.channelCount()]));
          break;
        case LayerKind::Total:
          *out = static_cast<float>(sums[c]);
          break;
        case LayerKind::Variance: {
          const double sum = c == 0 ? colour.r : c == 1 ? colour.g : colour.b;
          const double ofSplats = c == 0 ? splatVariance.r : c == 1 ? splatVariance.g : splatVariance.b;
          const double variance = varianceOfMean(sums, c, sum, colour.weight) + ofSplats;
          *out = static_cast<float>(variance * scale * scale);
          break;
        }
      }
    }
    sums += info.sumCount();
  }
}

}  // namespace pbrtmedia
