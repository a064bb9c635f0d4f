// SPDX-License-Identifier: BSD-2-Clause
#include "render/sampling_integrator.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "base/interruption.h"
#include "base/parallel.h"
#include "render/pass_loop.h"
#include "render/sample_taker.h"

namespace pbrtmedia {
namespace {

/// Memory of one pass at most, bytes.
constexpr std::size_t kPassBytes = std::size_t{64} << 20;
/// Splats that a sample is taken to have, for that.
constexpr std::size_t kSplatsPerSample = 4;

std::vector<Bounds2i> tilesOf(Bounds2i bounds, int size) {
  std::vector<Bounds2i> tiles;
  for (int y = bounds.min.y; y < bounds.max.y; y += size) {
    for (int x = bounds.min.x; x < bounds.max.x; x += size) {
      tiles.push_back(intersect(Bounds2i{{x, y}, {x + size, y + size}}, bounds));
    }
  }
  return tiles;
}

/// The common loop: passes over tiles of pixels.
class TileLoop {
 public:
  TileLoop(const Camera& camera, const Sampler& sampler, const SamplingIntegrator& integrator, Film& film,
           const RenderOptions& options)
      : camera_(camera),
        sampler_(sampler),
        integrator_(integrator),
        film_(film),
        options_(options),
        bounds_(options.pixelBounds ? intersect(film.sampleBounds(), *options.pixelBounds)
                                    : film.sampleBounds()),
        samplesPerPixel_(options.samplesPerPixel.value_or(sampler.samplesPerPixel())),
        tiles_(tilesOf(bounds_, std::max(1, options.tileSize))),
        loop_(integrator.scene(), options,
              {.end = std::min(samplesPerPixel_, options.endSample),
               .samplesPerIndex = static_cast<std::uint64_t>(bounds_.area()),
               .pixels = static_cast<std::uint64_t>(bounds_.area()),
               .mostPerPass = mostPerPass()}) {}

  RenderResult run() {
    return loop_.run([this](const Pass& pass) { return takeSamples(pass); },
                     [this](std::span<const UnitReport> reports) { addToFilm(reports); });
  }

 private:
  std::int64_t mostPerPass() const {
    const std::size_t perSample = sizeof(SamplePass::Sample) + film_.layers().sampleSize() * sizeof(float) +
                                  (integrator_.makesSplats() ? kSplatsPerSample * sizeof(Splat) : 0);
    const auto perIndex = static_cast<std::size_t>(film_.sampleBounds().area()) * perSample;
    return static_cast<std::int64_t>(std::max<std::size_t>(1, kPassBytes / perIndex));
  }

  std::vector<UnitReport> takeSamples(const Pass& pass) {
    taken_.emplace(film_.sampleBounds(), pass.count, film_.layers(), pass.first);
    splats_.assign(integrator_.makesSplats() ? tiles_.size() : 0, {});
    std::vector<UnitReport> reports(tiles_.size());
    parallelFor(tiles_.size(), [&](std::size_t i) {
      renderTile(tiles_[i], pass, *taken_, reports[i], splats_.empty() ? nullptr : &splats_[i]);
    });
    return reports;
  }

  void addToFilm(std::span<const UnitReport> reports) {
    film_.accumulate(*taken_);
    taken_.reset();
    if (splats_.empty()) return;
    std::uint64_t paths = 0;
    for (const UnitReport& report : reports) paths += report.samples;
    film_.addSplats(splats_, paths, film_.imageArea());
  }

  void renderTile(const Bounds2i& tile, const Pass& pass, SamplePass& samples, UnitReport& report,
                  SplatBuffer* splats) {
    SampleTaker taker(camera_, sampler_, integrator_, film_, options_, samplesPerPixel_);
    for (int y = tile.min.y; y < tile.max.y; ++y) {
      for (int x = tile.min.x; x < tile.max.x; ++x) {
        for (int s = 0; s < pass.count; ++s) {
          if (loop_.shouldStop()) return;
          try {
            if (splats) splats->begin(orderOf({x, y}, s));
            taker.take({x, y}, pass.first + s, s, samples, report, splats);
          } catch (const Interrupted&) {
            if (splats) splats->dropLast();
            ++report.abandoned;
            return;
          }
          if (s == 0) ++report.pixelsSampled;
        }
        loop_.count(static_cast<std::uint64_t>(pass.count));
      }
      loop_.reportProgress();
    }
    report.complete = true;
  }

  /// Of samples within a pass: by index, then pixels row by row, so that neither tiles nor the grouping into
  /// passes decide in which order splats are summed.
  std::uint64_t orderOf(Point2i pixel, int slot) const {
    const auto x = static_cast<std::uint64_t>(pixel.x - bounds_.min.x),
               y = static_cast<std::uint64_t>(pixel.y - bounds_.min.y);
    return static_cast<std::uint64_t>(slot) * static_cast<std::uint64_t>(bounds_.area()) +
           y * static_cast<std::uint64_t>(bounds_.width()) + x;
  }

  const Camera& camera_;
  const Sampler& sampler_;
  const SamplingIntegrator& integrator_;
  Film& film_;
  const RenderOptions& options_;
  Bounds2i bounds_;
  std::int64_t samplesPerPixel_;
  std::vector<Bounds2i> tiles_;
  std::optional<SamplePass> taken_;  ///< by the pass under way
  std::vector<SplatBuffer> splats_;  ///< by tiles
  PassLoop loop_;
};

}  // namespace

LayerMask SamplingIntegrator::layers() const {
  LayerMask mask = maskOf({Layer::Samples, Layer::Seconds, Layer::Lookups}) | layersOfRays();
  // Splats come from anywhere, and nobody knows how they vary.
  if (!makesSplats()) mask |= maskOf({Layer::Variance});
  return mask;
}

RenderResult SamplingIntegrator::render(const Camera& camera, const Sampler& sampler, Film& film,
                                        const RenderOptions& options) const {
  return TileLoop(camera, sampler, *this, film, options).run();
}

}  // namespace pbrtmedia
