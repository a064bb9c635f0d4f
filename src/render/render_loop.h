// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cameras/camera.h"
#include "fields/learned_bounds.h"
#include "film/film.h"
#include "render/integrator.h"
#include "world/media_tracker.h"

namespace pbrtmedia {

/// How far a render is. Samples are camera samples over all pixels.
struct RenderProgress {
  std::uint64_t samplesDone = 0, samplesTotal = 0;
  double seconds = 0;
};

/// What the render loop needs to know beyond the scene. The number of threads is the caller's ThreadLimit.
struct RenderOptions {
  std::uint64_t seed = 0;  ///< of the Rng of every sample; the sampler has its own copy
  /// Samples per pixel instead of the sampler's own count.
  std::optional<std::int64_t> samplesPerPixel = std::nullopt;
  std::int64_t firstSample = 0;  ///< sample indices below it are taken as done elsewhere
  std::optional<Bounds2i> pixelBounds = std::nullopt;  ///< further limits where samples are taken
  int tileSize = 16;                                   ///< pixels; has no effect on the image
  std::optional<int> samplesPerPass = std::nullopt;    ///< has no effect on the image; default: by memory
  double timeLimit = std::numeric_limits<double>::infinity();  ///< seconds of rendering
  const std::atomic<bool>* stop = nullptr;                     ///< set to true: stop soon
  /// Called on the calling thread after each pass, when the film holds everything taken so far. False: stop.
  std::function<bool(const RenderProgress&)> afterPass{};
  /// Called about ten times a second, from any one thread at a time.
  std::function<void(const RenderProgress&)> progress{};
  std::size_t maxRecords = 16;  ///< dropped samples, violations and mismatches that are kept
  /// Media whose bounds are learned (Medium::learnedBounds). If there are any, every pass takes one sample of
  /// each pixel, whatever samplesPerPass says, and publishes what it learned: so pass k sees the same bounds
  /// for any threads and tiles. Those that have learned nothing yet are explored before the first pass
  /// (Medium::exploreBounds), within a number of look-ups that follows the samples to take; that takes part
  /// of the time limit.
  std::vector<Medium*> learners{};
};

/// A sample that was kept off the film: enough to replay it.
struct DroppedSample {
  Point2i pixel;
  std::int64_t sample = 0;
  DropCause cause = DropCause::NotANumber;
  bool operator==(const DroppedSample&) const = default;
};

/// A density above its bound: enough to replay it.
struct ViolationRecord {
  Point2i pixel;
  std::int64_t sample = 0;
  BoundViolation violation;  ///< the first of the sample; its segment's worst. `medium` is not set
  std::string medium;
};

/// How the bounds of one medium were learned.
struct LearningRecord {
  std::string medium;
  bool restored = false;                 ///< from the bounds of another render
  int warmUpPasses = 0;                  ///< before the first sample
  std::int64_t warmUpBlockEdge = 1;      ///< Exploration::blockEdge
  bool warmUpIsLimited = false;          ///< to fewer passes, or coarser ones, by look-ups
  std::uint64_t warmUpLookups = 0;       ///< part of RenderCounters::densityLookups
  LearningProgress warmUp{};             ///< after them
  std::vector<LearningProgress> passes;  ///< of samples, after each publication
  /// The share of the medium's extinction that its bounds cut away, by a random point of each segment that
  /// samples asked it about: about what the image lacks of it. A mean over samples; passes after one that
  /// raised no bound count as 0.
  double shortfall = 0;

  /// Whether that is more than anybody should call the medium.
  bool isRising() const { return passes.empty() ? !restored : shortfall > kMostShortfall; }
  static constexpr double kMostShortfall = 1e-3;
};

struct RenderResult {
  std::uint64_t samplesTaken = 0, samplesTotal = 0;
  std::int64_t completedSamplesPerPixel = 0;  ///< sample indices below it are taken in every pixel
  RenderCounters counters;
  double seconds = 0;
  bool interrupted = false;  ///< stopped before the last sample
  /// Samples whose paths were under way when the run was to stop and did not end soon: not on the film.
  std::uint64_t samplesAbandoned = 0;
  std::uint64_t pixelsTotal = 0, pixelsSampled = 0;  ///< the latter have a sample at least
  /// The first in order of pixel (row by row), then sample; each at most RenderOptions::maxRecords.
  std::vector<DroppedSample> dropped;
  std::vector<MediumMismatch> mismatches;
  std::vector<ViolationRecord> violations;
  std::vector<LearningRecord> learning;  ///< one for each of RenderOptions::learners
};

/// Takes the samples of an image and accumulates them on the film, in passes over the film. Every sample is a
/// pure function of (seed, pixel, sample index), and of the passes before where bounds are learned: image,
/// counters and records are the same for any number of threads, tile size and grouping into passes. Stopped
/// early (time, flag, callback) it leaves the film with exactly the samples that were taken; a path that is
/// left on its way (leaveIfAbandoned) is none.
RenderResult renderFilm(const Camera& camera, const Sampler& sampler, const Integrator& integrator,
                        Film& film, const RenderOptions& options);

/// One sample again, as the loop takes it: for replays. Radiance before the film admits it.
Rgb renderSample(const Camera& camera, Sampler& sampler, const Integrator& integrator, Point2i pixel,
                 std::int64_t sample, std::int64_t samplesPerPixel, std::uint64_t seed,
                 RenderCounters& counters, MismatchLog* mismatches = nullptr, Point2f* film = nullptr);

}  // namespace pbrtmedia
