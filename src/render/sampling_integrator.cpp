// SPDX-License-Identifier: BSD-2-Clause
#include "render/sampling_integrator.h"

#include <glog/logging.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/byte_stream.h"
#include "base/diagnostics.h"
#include "base/interruption.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "film/side_images.h"
#include "lighting/light_selector.h"
#include "lighting/light_trials.h"
#include "render/light_exploration.h"
#include "render/pass_loop.h"
#include "render/pass_shares.h"
#include "render/ranks.h"
#include "render/sample_delivery.h"
#include "render/sample_taker.h"
#include "render/state_stream.h"

namespace pbrtmedia {
namespace {

/// Memory of one pass at most, bytes.
constexpr std::size_t kPassBytes = std::size_t{64} << 20;
/// Splats that a sample is taken to have, for that.
constexpr std::size_t kSplatsPerSample = 4;

int tileEdge(const Bounds2i& bounds, const RenderOptions& options, Ranks& ranks) {
  const int edge = std::max(1, options.tileSize);
  if (ranks.isAlone()) return edge;
  std::uint64_t threads[] = {threadCount()};
  ranks.addUp(threads);
  return PassShares::tileEdge(bounds, edge, threads[0]);
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
        ranks_(options.ranks ? *options.ranks : oneRank()),
        shares_({.ranks = ranks_.count(),
                 .tiles = PassShares::tilesOf(bounds_, tileEdge(bounds_, options, ranks_)),
                 .film = film.pixelBounds(),
                 .firstNeighbour = film.firstNeighbourRow(),
                 .lastNeighbour = film.lastNeighbourRow()}),
        costs_(shares_.tiles().size()),
        loop_(integrator.scene(), options,
              {.end = std::min(samplesPerPixel_, options.endSample),
               .samplesPerIndex = static_cast<std::uint64_t>(bounds_.area()),
               .pixels = static_cast<std::uint64_t>(bounds_.area()),
               .mostPerPass = mostPerPass()}) {
    const RowRange rows = shares_.summedBy(ranks_.rank());
    film_.sumOnly(rows.first, rows.end);
    CHECK(!options.sides || ranks_.isAlone()) << "side images are of one process";
  }

  RenderResult run() {
    return loop_.run([this](const Pass& pass) { return takeSamples(pass); },
                     [this](std::span<const UnitReport> units) { addToFilm(units); },
                     [this] { collectFilm(); });
  }

 private:
  std::int64_t mostPerPass() const {
    const std::size_t perSample = sizeof(SamplePass::Sample) + film_.layers().sampleSize() * sizeof(float) +
                                  (integrator_.makesSplats() ? kSplatsPerSample * sizeof(Splat) : 0) +
                                  (options_.sides ? options_.sides->count() * sizeof(Splat) : 0);
    const auto perIndex = static_cast<std::size_t>(film_.sampleBounds().area()) * perSample;
    return static_cast<std::int64_t>(std::max<std::size_t>(1, kPassBytes / perIndex));
  }

  std::vector<UnitReport> takeSamples(const Pass& pass) {
    RenderCounters explored;
    exploreLights(explored);
    balance();
    const std::span<const std::size_t> tiles = shares_.takenBy(ranks_.rank());
    prepare(pass, tiles);
    splats_.assign(integrator_.makesSplats() ? tiles.size() : 0, {});
    if (options_.sides) sides_.assign(tiles.size(), SideImages::Unit(options_.sides->count()));
    std::vector<UnitReport> reports(tiles.size());
    parallelFor(tiles.size(), [&](std::size_t i) {
      const Stopwatch watch;
      renderTile(shares_.tiles()[tiles[i]], pass, *taken_, reports[i],
                 splats_.empty() ? nullptr : &splats_[i],
                 sides_.empty() ? std::span<SplatBuffer>() : std::span<SplatBuffer>(sides_[i]));
      costs_[tiles[i]] += static_cast<std::uint64_t>(watch.seconds() * 1e9);
    });
    if (ranks_.isFirst() && !reports.empty()) reports.front().counters.add(explored);
    return reports;
  }

  /// What lights bring, before the first pass; of a render that goes on it was found out before.
  void exploreLights(RenderCounters& counters) {
    const LightSelector* const learner = integrator_.learner();
    if (areLightsExplored_ || !learner || !learner->canLearn()) return;
    areLightsExplored_ = true;
    std::vector<double>& learned = loop_.carried();
    if (learned.empty()) {
      learner->learn({});  // what another render with the same integrator has found is forgotten
      const std::optional<LightTrials> trials = pbrtmedia::exploreLights(
          camera_, film_.settings().resolution, integrator_, options_.seed,
          [this] { return loop_.shouldStop(); }, counters);
      if (trials) learned = learner->learn(*trials);
    } else if (!learner->recall(learned)) {
      throw SceneError({}, "the checkpoint does not have what was learned of the scene's lights");
    }
  }

  /// Memory for a pass. With several ranks that of the last one serves again: nobody looks at what is neither
  /// taken here nor delivered.
  void prepare(const Pass& pass, std::span<const std::size_t> tiles) {
    if (ranks_.isAlone() || !taken_ || taken_->samplesPerPixel() != pass.count) {
      taken_.emplace(film_.sampleBounds(), pass.count, film_.layers(), pass.first);
      return;
    }
    taken_->setFirstIndex(pass.first);
    for (const std::size_t tile : tiles) taken_->clear(shares_.tiles()[tile]);
  }

  /// Shares the tiles by what they have cost: after 1, 2, 4, 8 ... passes, as costs hardly change later.
  void balance() {
    const int passes = passes_++;
    if (ranks_.isAlone() || passes == 0 || (passes & (passes - 1)) != 0) return;
    std::vector<std::uint64_t> costs = costs_;
    ranks_.addUp(costs);
    shares_.balance(costs);
  }

  void addToFilm(std::span<const UnitReport> units) {
    std::vector<SplatBuffer> others;
    if (!ranks_.isAlone())
      others = deliver(ranks_, shares_, *taken_, integrator_.makesSplats() ? &splats_ : nullptr);
    film_.accumulate(*taken_);
    if (options_.sides) options_.sides->add(sides_, *taken_, loop_.samplesOfPass());
    if (ranks_.isAlone()) taken_.reset();
    if (!integrator_.makesSplats()) return;
    for (SplatBuffer& buffer : others) splats_.push_back(std::move(buffer));
    film_.addSplats(splats_, {loop_.samplesOfPass(), film_.imageArea()}, oddSamples(units));
  }

  /// Of all ranks, where the film wants to know.
  std::uint64_t oddSamples(std::span<const UnitReport> units) {
    if (!film_.hasHalves()) return 0;
    std::uint64_t count[] = {0};
    for (const UnitReport& unit : units) count[0] += unit.oddSamples;
    if (!ranks_.isAlone()) ranks_.addUp(count);
    return count[0];
  }

  void collectFilm() {
    const RowRange own = shares_.summedBy(ranks_.rank());
    ByteWriter out;
    writeFilm(out, integrator_.scene(), film_.rows(own.first, own.end));
    const std::vector<std::string> parts = ranks_.gather(ranks_.isFirst() ? std::string() : out.text());
    for (std::size_t rank = 1; rank < parts.size(); ++rank) {
      ByteReader in(parts[rank]);
      const RowRange rows = shares_.summedBy(rank);
      CHECK(film_.setRows(rows.first, rows.end, readFilm(in, integrator_.scene())));
    }
  }

  void renderTile(const Bounds2i& tile, const Pass& pass, SamplePass& samples, UnitReport& report,
                  SplatBuffer* splats, std::span<SplatBuffer> sides) {
    SampleTaker taker(camera_, sampler_, integrator_, film_, options_, samplesPerPixel_);
    takeTile(tile, pass, taker, samples, report, splats, sides);
    report.counters.densityLookups += taker.sharedLookups();
  }

  void takeTile(const Bounds2i& tile, const Pass& pass, SampleTaker& taker, SamplePass& samples,
                UnitReport& report, SplatBuffer* splats, std::span<SplatBuffer> sides) {
    for (int y = tile.min.y; y < tile.max.y; ++y) {
      for (int x = tile.min.x; x < tile.max.x; ++x) {
        for (int s = 0; s < pass.count; ++s) {
          if (loop_.shouldStop()) return;
          try {
            if (splats) splats->begin(orderOf({x, y}, s), (pass.first + s) % 2 != 0);
            for (SplatBuffer& side : sides) side.begin(orderOf({x, y}, s));
            taker.take({x, y}, pass.first + s, s, samples, report, splats, sides);
          } catch (const Interrupted&) {
            if (splats) splats->dropLast();
            for (SplatBuffer& side : sides) side.dropLast();
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
  Ranks& ranks_;
  PassShares shares_;
  std::vector<std::uint64_t> costs_;  ///< of tiles so far, nanoseconds of this rank's threads
  int passes_ = 0;
  std::optional<SamplePass> taken_;      ///< by the pass under way
  std::vector<SplatBuffer> splats_;      ///< by tiles
  std::vector<SideImages::Unit> sides_;  ///< the same; empty where nobody wants them
  bool areLightsExplored_ = false;
  PassLoop loop_;
};

}  // namespace

LayerMask SamplingIntegrator::layers() const {
  return maskOf({Layer::Samples, Layer::Seconds, Layer::Lookups, Layer::Variance}) | layersOfRays();
}

RenderResult SamplingIntegrator::render(const Camera& camera, const Sampler& sampler, Film& film,
                                        const RenderOptions& options) const {
  return TileLoop(camera, sampler, *this, film, options).run();
}

}  // namespace pbrtmedia
