// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/explored_stretch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "singlescattering/explore.h"
#include "singlescattering/shared_explorers.h"

namespace pbrtmedia {
namespace {

/// Of a stretch that no neighbour has explored.
constexpr std::size_t kOwnExplorers = 12;
/// Least rate, as shares of the main part's mean and of what the bounds say: what explorers missed must not
/// be weighted by much (with difference²/rate <= 2 extinction second moments stay below 1).
constexpr double kLeastOfMainPart = 0.1, kLeastOfBounds = 0.25;
/// Transmittance below which a walk may end.
constexpr float kLittle = 0.01f;

}  // namespace

std::optional<ExploredStretch> ExploredStretch::over(const LitStretch& stretch,
                                                     std::span<const Explorer> near,
                                                     RenderCounters& counters) {
  const MediaStretch& media = stretch.media;
  if (!isExplorable(media)) return std::nullopt;
  std::vector<Explorer> own;
  near = explorersBetween(near, media.tMin(), media.tMax());
  if (near.empty()) {
    explore(media, kOwnExplorers, 0.5, counters, own);
    near = own;
  }
  ExploredStretch explored{stretch, MainPart(near, media.tMin(), media.tMax()), 0};
  const double depth = *std::ranges::max_element(explored.mainPart.depth());
  explored.rate =
      std::max({explored.mainPart.largestDifference(), kLeastOfMainPart * depth / explored.mainPart.length(),
                kLeastOfBounds * stretch.extinction});
  return explored;
}

ExploredWalk::ExploredWalk(const ExploredStretch& stretch, double rate, Rng& rng, RenderCounters& counters)
    : stretch_(stretch),
      rate_(rate),
      rng_(rng),
      counters_(counters),
      ahead_(stretch.mainPart.tMin() + rng.exponential() / rate) {}

Rgb ExploredWalk::through(const MainPart::Value& value) const {
  Rgb result;
  for (std::size_t c = 0; c < 3; ++c) result[c] = static_cast<float>(weight_[c] * std::exp(-value.depth[c]));
  return result;
}

std::optional<ExploredWalk::Step> ExploredWalk::stepBefore(double t) {
  if (isOver_ || !(ahead_ < t)) return std::nullopt;
  const MainPart::Value value = stretch_.mainPart.at(ahead_);
  const Step step{ahead_, through(value), stretch_.lit.media.coefficients(ahead_, counters_)};
  ++counters_.nullCollisions;
  for (std::size_t c = 0; c < 3; ++c)
    weight_[c] *= 1 - (double{step.there.sigmaT[c]} - value.extinction[c]) / rate_;
  const Rgb left = through(value);
  const float most = std::max({std::abs(left.r), std::abs(left.g), std::abs(left.b)});
  if (most < kLittle) {
    isOver_ = most == 0 || rng_.uniform() < 0.5f;
    for (double& w : weight_) w *= 2;
  }
  ahead_ += rng_.exponential() / rate_;
  return step;
}

Rgb ExploredWalk::transmittanceTo(double t) {
  while (stepBefore(t)) {
  }
  return isOver_ ? Rgb() : through(stretch_.mainPart.at(t));
}

}  // namespace pbrtmedia
