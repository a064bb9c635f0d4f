// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/shared_explorers.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/rng.h"
#include "singlescattering/explore.h"
#include "world/media_walk.h"

namespace pbrtmedia {
namespace {

/// "xplr" in ASCII: keeps these random numbers apart from those of samples.
constexpr std::uint64_t kTag = 0x78706c72;
/// Of each stretch of the middle ray, and of each of the four others.
constexpr std::size_t kExplorers = 32, kChecks = 4;
/// Stretches of a ray; what lies behind so many explores for itself.
constexpr int kMostStretches = 16;

int blockOf(int pixel) {
  constexpr int n = SharedExplorers::kBlock;
  return pixel >= 0 ? pixel / n : -((-pixel + n - 1) / n);
}

}  // namespace

std::span<const Explorer> explorersBetween(std::span<const Explorer> explorers, double tMin, double tMax) {
  const auto first = std::ranges::lower_bound(explorers, tMin, {}, &Explorer::t);
  const auto end = std::ranges::upper_bound(first, explorers.end(), tMax, {}, &Explorer::t);
  return {first, end};
}

std::span<const Explorer> SharedExplorers::of(Point2i pixel) {
  const Point2i block{blockOf(pixel.x), blockOf(pixel.y)};
  const auto key = (std::uint64_t{static_cast<std::uint32_t>(block.x)} << 32) |
                   std::uint64_t{static_cast<std::uint32_t>(block.y)};
  const auto [found, isNew] = blocks_.try_emplace(key);
  if (isNew) found->second = exploreBlock(block);
  return found->second;
}

/// The stretches of a camera ray that can be explored, up to the first surface with a material.
template <class Visit>
void SharedExplorers::visitStretches(Point2f film, RenderCounters& counters, Visit&& visit) const {
  const Camera::WeightedRay camera = camera_.generateRay(film, {0.5f, 0.5f}, 0.5f);
  if (camera.weight == 0) return;
  MediumState state = media_.stateOf(camera.ray, counters);
  const MediaWalk::Context context{media_.scene(), &media_, counters, counters.rays};
  MediaWalk walk(context, state, LineWalk::fromCamera(media_.scene(), camera.ray));
  for (int i = 0; i < kMostStretches; ++i) {
    walk.ahead();
    if (isExplorable(walk.stretch())) visit(walk.stretch());
    const std::optional<SceneHit> hit = walk.next();
    if (!hit || hit->primitive->material) return;
    walk.cross(*hit);
  }
}

std::vector<Explorer> SharedExplorers::exploreBlock(Point2i block) {
  RenderCounters counters;
  Rng rng(hashCombine(seed_, static_cast<std::uint32_t>(block.x), static_cast<std::uint32_t>(block.y), kTag));
  const auto at = [&](float x, float y) {
    constexpr auto n = static_cast<float>(kBlock);
    return Point2f{(static_cast<float>(block.x) + x) * n, (static_cast<float>(block.y) + y) * n};
  };
  std::vector<Explorer> explorers;
  visitStretches(at(0.5f, 0.5f), counters, [&](const MediaStretch& stretch) {
    explore(stretch, kExplorers, rng.uniformDouble(), counters, explorers);
  });
  for (Explorer& e : explorers) e.difference = 0;
  for (const auto [x, y] : {Point2f{.25f, .25f}, {.75f, .25f}, {.25f, .75f}, {.75f, .75f}}) {
    visitStretches(at(x, y), counters, [&](const MediaStretch& stretch) {
      const auto near = explorersBetween(explorers, stretch.tMin(), stretch.tMax());
      if (near.empty()) return;
      const MainPart mainPart(near, stretch.tMin(), stretch.tMax());
      double largest = 0;
      for (std::size_t i = 0; i < kChecks; ++i) {
        const double share = (static_cast<double>(i) + rng.uniformDouble()) / double{kChecks};
        const double t = stretch.tMin() + share * (stretch.tMax() - stretch.tMin());
        const Rgb sigmaT = stretch.coefficients(t, counters).sigmaT;
        const MainPart::Channels expected = mainPart.at(t).extinction;
        for (std::size_t c = 0; c < 3; ++c)
          largest = std::max(largest, std::abs(double{sigmaT[c]} - expected[c]));
      }
      for (Explorer& e : explorers) {
        if (e.t >= stretch.tMin() && e.t <= stretch.tMax()) e.difference = std::max(e.difference, largest);
      }
    });
  }
  lookups_ += counters.densityLookups;
  return explorers;
}

}  // namespace pbrtmedia
