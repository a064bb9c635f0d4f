// SPDX-License-Identifier: BSD-2-Clause
#include "render/light_exploration.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/hash.h"
#include "base/interruption.h"
#include "base/math.h"
#include "base/parallel.h"
#include "cameras/camera.h"
#include "render/sampling_integrator.h"
#include "render/tile_memory.h"
#include "samplers/random.h"

namespace pbrtmedia {
namespace {

/// "lght" in ASCII: keeps the random numbers apart from other uses of the same seed.
constexpr std::uint64_t kTag = 0x6c676874;
constexpr std::uint64_t kMostPaths = 16384, kPixelsPerPath = 8, kChunk = 128;

/// Points of the unit square that fill it evenly: multiples of the powers of the plastic number's inverse.
Point2f evenly(std::uint64_t i) {
  const auto along = [i](double step) {
    const double x = 0.5 + step * static_cast<double>(i);
    return std::min(static_cast<float>(x - std::floor(x)), kOneMinusEpsilon);
  };
  return {along(0.7548776662466927), along(0.5698402909980532)};
}

}  // namespace

std::optional<LightTrials> exploreLights(const Camera& camera, Point2i resolution,
                                         const SamplingIntegrator& integrator, std::uint64_t seed,
                                         const std::function<bool()>& shouldStop, RenderCounters& counters) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(resolution.x) * static_cast<std::uint64_t>(resolution.y);
  const std::uint64_t paths = std::clamp<std::uint64_t>(pixels / kPixelsPerPath, 1, kMostPaths);
  struct Part {
    LightTrials trials;
    RenderCounters counters;
    bool isWhole = false;
  };
  std::vector<Part> parts((paths + kChunk - 1) / kChunk);
  parallelFor(parts.size(), [&](std::size_t part) {
    Part& own = parts[part];
    const std::unique_ptr<TileMemory> memory = integrator.tileMemory(camera, seed);
    RandomSampler sampler({.pixelSamples = 1, .seed = hashCombine(seed, kTag)});
    for (std::uint64_t i = part * kChunk; i < std::min(paths, (part + 1) * kChunk); ++i) {
      if (shouldStop()) return;
      sampler.start({static_cast<int>(i), 0}, 0);
      const Point2f place = evenly(i), lens = sampler.get2D();
      const Point2f film{place.x * static_cast<float>(resolution.x),
                         place.y * static_cast<float>(resolution.y)};
      const Camera::WeightedRay weighted = camera.generateRay(film, lens, sampler.get1D());
      if (weighted.weight == 0) continue;
      Rng rng(hashCombine(seed, i, kTag));
      SampleContext context{sampler, rng, own.counters};
      context.lightTrials = &own.trials;
      context.camera = &camera;
      context.pixel = {static_cast<int>(film.x), static_cast<int>(film.y)};
      context.memory = memory.get();
      own.trials.startPath(i);
      try {
        integrator.radiance(weighted.ray, context);
      } catch (const Interrupted&) {
        return;
      }
    }
    if (memory) own.counters.densityLookups += memory->lookups();
    own.isWhole = true;
  });
  LightTrials all;
  for (const Part& part : parts) {
    all.append(part.trials);
    counters.add(part.counters);
    if (!part.isWhole) return std::nullopt;
  }
  return all;
}

}  // namespace pbrtmedia
