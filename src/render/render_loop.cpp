// SPDX-License-Identifier: BSD-2-Clause
#include "render/render_loop.h"

#include <algorithm>
#include <mutex>
#include <tuple>
#include <utility>

#include "base/hash.h"
#include "base/interruption.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "fields/exploration.h"
#include "fields/learned_bounds.h"
#include "media/medium.h"

namespace pbrtmedia {
namespace {

/// Memory of one pass at most, bytes.
constexpr std::size_t kPassBytes = std::size_t{64} << 20;
/// "ptrn" in ASCII: the same for patterns across the samples of a pixel.
constexpr std::uint64_t kPatternTag = 0x7074726e;
/// "path" in ASCII: keeps the Rng of samples apart from other uses of the same seed.
constexpr std::uint64_t kRngTag = 0x70617468;
/// "warm" in ASCII: the same for the exploration of bounds.
constexpr std::uint64_t kWarmUpTag = 0x7761726d;
/// One thread explores this many blocks of super-voxels at a time, or a share of all.
constexpr std::size_t kLeastBlocks = 64, kMostChunks = 4096;
/// Look-ups to explore the bounds of all media, for each camera sample of the render: a small part of what a
/// sample in a medium makes itself (10 to 100).
constexpr std::uint64_t kWarmUpPerSample = 4;
/// But as many for one medium may be made in any case: four passes over 32 x 32 x 32 super-voxels, a
/// fraction of a second.
constexpr std::uint64_t kLeastWarmUp = std::uint64_t{1} << 21;
constexpr double kProgressInterval = 0.1;  // seconds

/// A rectangle of the film that one thread renders, and what came out besides radiance.
struct Tile {
  Bounds2i pixels;
  RenderCounters counters;
  std::uint64_t samples = 0, abandoned = 0, pixelsSampled = 0;
  std::vector<DroppedSample> dropped;
  std::vector<MediumMismatch> mismatches;
  std::vector<ViolationRecord> violations;
  bool complete = false;
};

std::vector<Tile> tilesOf(Bounds2i bounds, int size) {
  std::vector<Tile> tiles;
  for (int y = bounds.min.y; y < bounds.max.y; y += size) {
    for (int x = bounds.min.x; x < bounds.max.x; x += size) {
      tiles.emplace_back().pixels = intersect(Bounds2i{{x, y}, {x + size, y + size}}, bounds);
    }
  }
  return tiles;
}

DropCause causeOf(const RenderCounters& before, const RenderCounters& after) {
  for (std::size_t i = 0; i < before.dropped.size(); ++i) {
    if (after.dropped[i] != before.dropped[i]) return static_cast<DropCause>(i);
  }
  return DropCause::NotANumber;
}

/// Keeps the first `most` records in order of pixel, then sample. Since every tile notes its records in this
/// very order, what is kept does not depend on tiles, threads and passes.
template <class Record>
void mergeRecords(std::vector<Record>& all, const std::vector<Record>& more, std::size_t most) {
  all.insert(all.end(), more.begin(), more.end());
  const auto key = [](const Record& r) { return std::make_tuple(r.pixel.y, r.pixel.x, r.sample); };
  std::stable_sort(all.begin(), all.end(), [&](const Record& a, const Record& b) { return key(a) < key(b); });
  if (all.size() > most) all.resize(most);
}

class RenderLoop {
 public:
  RenderLoop(const Camera& camera, const Sampler& sampler, const Integrator& integrator, Film& film,
             const RenderOptions& options)
      : camera_(camera),
        sampler_(sampler),
        integrator_(integrator),
        film_(film),
        options_(options),
        bounds_(film.sampleBounds()),
        samplesPerPixel_(options.samplesPerPixel.value_or(sampler.samplesPerPixel())) {
    if (options.pixelBounds) bounds_ = intersect(bounds_, *options.pixelBounds);
    for (Medium* learner : options.learners) {
      LearningRecord record;
      record.medium = learner->name();
      record.restored = learner->learnedBounds()->isRestored();
      result_.learning.push_back(std::move(record));
    }
  }

  RenderResult run() {
    const auto area = static_cast<std::uint64_t>(bounds_.area());
    result_.samplesTotal =
        area * static_cast<std::uint64_t>(std::max<std::int64_t>(samplesPerPixel_ - options_.firstSample, 0));
    result_.pixelsTotal = area;
    result_.completedSamplesPerPixel = options_.firstSample;
    if (result_.samplesTotal > 0) warmUp();
    std::int64_t next = options_.firstSample;
    for (int pass = 0; area > 0 && next < samplesPerPixel_ && !shouldStop(); ++pass) {
      const auto count = static_cast<int>(std::min<std::int64_t>(passSize(pass), samplesPerPixel_ - next));
      const bool complete = renderPass(next, count);
      next += count;
      if (!complete) break;
      result_.completedSamplesPerPixel = next;
      if (options_.afterPass && !options_.afterPass(progress())) break;
    }
    if (area == 0) result_.completedSamplesPerPixel = std::max(samplesPerPixel_, options_.firstSample);
    result_.interrupted = result_.samplesTaken < result_.samplesTotal;
    result_.seconds = watch_.seconds();
    return std::move(result_);
  }

 private:
  /// Where the render may be stopped early the first passes are small, so that the whole film gets samples
  /// soon.
  std::int64_t passSize(int pass) const {
    if (!options_.learners.empty()) return 1;
    if (options_.samplesPerPass) return std::max(1, *options_.samplesPerPass);
    const auto perSample = static_cast<std::size_t>(film_.sampleBounds().area()) * sizeof(SamplePass::Sample);
    const auto byMemory = static_cast<std::int64_t>(std::max<std::size_t>(1, kPassBytes / perSample));
    if (!isTimed() && !options_.stop) return byMemory;
    return std::min(byMemory, std::int64_t{1} << std::min(pass, 30));
  }

  bool isTimed() const { return options_.timeLimit < std::numeric_limits<double>::infinity(); }

  bool shouldStop() const {
    if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return true;
    return isTimed() && watch_.seconds() >= options_.timeLimit;
  }

  RenderProgress progress() const {
    return {samplesDone_.load(std::memory_order_relaxed), result_.samplesTotal, watch_.seconds()};
  }

  /// Samples [first, first + count) of every pixel. False: stopped on the way.
  bool renderPass(std::int64_t first, int count) {
    SamplePass pass(film_.sampleBounds(), count);
    std::vector<Tile> tiles = tilesOf(bounds_, std::max(1, options_.tileSize));
    parallelFor(tiles.size(), [&](std::size_t i) { renderTile(tiles[i], pass, first, count); });
    film_.accumulate(pass);
    bool complete = true;
    const std::uint64_t samplesBefore = result_.samplesTaken;
    for (const Tile& tile : tiles) {
      complete &= tile.complete;
      result_.samplesTaken += tile.samples;
      result_.samplesAbandoned += tile.abandoned;
      if (first == options_.firstSample) result_.pixelsSampled += tile.pixelsSampled;
      result_.counters.add(tile.counters);
      mergeRecords(result_.dropped, tile.dropped, options_.maxRecords);
      mergeRecords(result_.mismatches, tile.mismatches, options_.maxRecords);
      mergeRecords(result_.violations, tile.violations, options_.maxRecords);
    }
    publishLearned(result_.samplesTaken - samplesBefore);
    return complete;
  }

  /// Look-ups that the exploration of one medium may take.
  std::uint64_t warmUpBudget() const {
    return std::max(kLeastWarmUp, kWarmUpPerSample * result_.samplesTotal / options_.learners.size());
  }

  /// Explores the bounds that nobody knows anything of, and puts what was found into force.
  void warmUp() {
    for (std::size_t i = 0; i < options_.learners.size(); ++i) {
      const Medium& medium = *options_.learners[i];
      LearnedBounds& bounds = *options_.learners[i]->learnedBounds();
      LearningRecord& record = result_.learning[i];
      record.warmUpPasses = bounds.warmUpPasses();
      if (record.warmUpPasses == 0) continue;
      const auto planned = [&](int passes) {
        return planExploration(bounds.inForce().shape(), passes,
                               bounds.params().warmUpLookups.value_or(warmUpBudget()));
      };
      const Exploration plan = planned(record.warmUpPasses);
      record.warmUpIsLimited = plan.blockEdge > 1 || planned(plan.passes + 1).passes == plan.passes;
      record.warmUpPasses = plan.passes;
      record.warmUpBlockEdge = plan.blockEdge;
      if (plan.passes == 0) continue;
      const std::size_t blocks = plan.blockCount();
      const std::size_t chunk = std::max(kLeastBlocks, blocks / kMostChunks),
                        chunks = (blocks + chunk - 1) / chunk;
      const std::uint64_t seed = hashCombine(options_.seed, kWarmUpTag, static_cast<std::uint64_t>(i));
      std::vector<RenderCounters> counters(chunks);
      parallelFor(chunks, [&](std::size_t c) {
        if (shouldStop()) return;
        medium.exploreBounds(plan, c * chunk, std::min(blocks, (c + 1) * chunk), seed, counters[c]);
      });
      for (const RenderCounters& c : counters) {
        record.warmUpLookups += c.densityLookups;
        result_.counters.add(c);
      }
      bounds.publish();
      record.warmUp = bounds.progress();
    }
  }

  /// `samples`: of the pass.
  void publishLearned(std::uint64_t samples) {
    for (std::size_t i = 0; i < options_.learners.size(); ++i) {
      LearnedBounds& bounds = *options_.learners[i]->learnedBounds();
      LearningRecord& record = result_.learning[i];
      bounds.publish();
      record.passes.push_back(bounds.progress());
      shortfalls_[i] += bounds.progress().shortfall * static_cast<double>(samples);
      if (result_.samplesTaken > 0)
        record.shortfall = shortfalls_[i] / static_cast<double>(result_.samplesTaken);
    }
  }

  void renderTile(Tile& tile, SamplePass& pass, std::int64_t first, int count) {
    const std::unique_ptr<Sampler> sampler = sampler_.clone();
    for (int y = tile.pixels.min.y; y < tile.pixels.max.y; ++y) {
      for (int x = tile.pixels.min.x; x < tile.pixels.max.x; ++x) {
        for (int s = 0; s < count; ++s) {
          if (shouldStop()) return;
          try {
            takeSample(tile, *sampler, {x, y}, first + s, pass.at({x, y}, s));
          } catch (const Interrupted&) {
            ++tile.abandoned;
            return;
          }
          if (s == 0) ++tile.pixelsSampled;
        }
        samplesDone_.fetch_add(static_cast<std::uint64_t>(count), std::memory_order_relaxed);
      }
      reportProgress();
    }
    tile.complete = true;
  }

  void takeSample(Tile& tile, Sampler& sampler, Point2i pixel, std::int64_t index, SamplePass::Sample& out) {
    MismatchLog log{
        pixel, index, options_.maxRecords - std::min(options_.maxRecords, tile.mismatches.size()), {}};
    Point2f film;
    tile.counters.violation.reset();
    Rgb radiance = renderSample(camera_, sampler, integrator_, pixel, index, samplesPerPixel_, options_.seed,
                                tile.counters, &log, &film);
    tile.mismatches.insert(tile.mismatches.end(), log.entries.begin(), log.entries.end());
    if (tile.counters.violation && tile.violations.size() < options_.maxRecords) {
      ViolationRecord record{pixel, index, *tile.counters.violation, {}};
      record.medium = std::exchange(record.violation.medium, {});
      tile.violations.push_back(std::move(record));
    }
    const RenderCounters before = tile.counters;
    if (!film_.admit(radiance, tile.counters)) {
      if (tile.dropped.size() < options_.maxRecords) {
        tile.dropped.push_back({pixel, index, causeOf(before, tile.counters)});
      }
      radiance = {};
    }
    out.offset = {film.x - static_cast<float>(pixel.x), film.y - static_cast<float>(pixel.y)};
    out.radiance = radiance;
    out.valid = true;
    ++tile.samples;
  }

  void reportProgress() {
    if (!options_.progress) return;
    const std::unique_lock<std::mutex> lock(progressMutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    const RenderProgress now = progress();
    if (now.seconds - lastReport_ < kProgressInterval) return;
    lastReport_ = now.seconds;
    options_.progress(now);
  }

  const Camera& camera_;
  const Sampler& sampler_;
  const Integrator& integrator_;
  Film& film_;
  const RenderOptions& options_;
  Bounds2i bounds_;
  std::int64_t samplesPerPixel_;
  Stopwatch watch_;
  RenderResult result_;
  std::vector<double> shortfalls_ = std::vector<double>(options_.learners.size());  ///< of samples, added up
  std::atomic<std::uint64_t> samplesDone_{0};
  std::mutex progressMutex_;
  double lastReport_ = 0;
};

}  // namespace

RenderResult renderFilm(const Camera& camera, const Sampler& sampler, const Integrator& integrator,
                        Film& film, const RenderOptions& options) {
  return RenderLoop(camera, sampler, integrator, film, options).run();
}

Rgb renderSample(const Camera& camera, Sampler& sampler, const Integrator& integrator, Point2i pixel,
                 std::int64_t sample, std::int64_t samplesPerPixel, std::uint64_t seed,
                 RenderCounters& counters, MismatchLog* mismatches, Point2f* film) {
  sampler.start(pixel, sample);
  const CameraSample cameraSample = sampler.cameraSample(pixel);
  if (film) *film = cameraSample.film;
  ++counters.cameraSamples;
  Camera::WeightedRay weighted = camera.generateRay(cameraSample.film, cameraSample.lens, cameraSample.time);
  if (weighted.weight == 0) return {};
  weighted.ray.scaleDifferentials(1 /
                                  std::sqrt(static_cast<float>(std::max<std::int64_t>(samplesPerPixel, 1))));
  Rng rng(hashCombine(seed, static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y),
                      static_cast<std::uint64_t>(sample), kRngTag));
  const PixelSample pixelSample{hashCombine(seed, static_cast<std::uint32_t>(pixel.x),
                                            static_cast<std::uint32_t>(pixel.y), kPatternTag),
                                static_cast<std::uint64_t>(sample),
                                static_cast<std::uint64_t>(std::max<std::int64_t>(samplesPerPixel, 0)), 0};
  SampleContext context{sampler, rng, counters, mismatches, pixelSample};
  return weighted.weight * integrator.radiance(weighted.ray, context);
}

}  // namespace pbrtmedia
