// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/statistics.h"
#include "base/vec.h"
#include "fields/learned_bounds.h"
#include "world/medium_mismatch.h"

namespace pbrtmedia {

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
  double shortfallOfSamples = 0;         ///< those of the passes, times their samples
  /// The share of the medium's extinction that its bounds cut away, by a random point of each segment that
  /// samples asked it about: about what the image lacks of it. A mean over samples; passes after one that
  /// raised no bound count as 0.
  double shortfall = 0;

  /// Whether that is more than anybody should call the medium.
  bool isRising() const { return passes.empty() ? !restored : shortfall > kMostShortfall; }
  static constexpr double kMostShortfall = 1e-3;
};

/// What ended a render before its last sample.
enum class EarlyStop { None, Asked, Time, Lookups };

/// What came of a render besides the image.
struct RenderResult {
  std::uint64_t samplesTaken = 0, samplesTotal = 0;
  std::int64_t completedSamplesPerPixel = 0;  ///< sample indices below it are taken in every pixel
  RenderCounters counters;
  double seconds = 0, cpuSeconds = 0;     ///< wall-clock and of all threads, without RenderOptions::afterPass
  std::uint64_t passes = 0;               ///< of this part of the render
  bool interrupted = false;               ///< stopped before the last sample
  EarlyStop stoppedBy = EarlyStop::None;  ///< Asked: by RenderOptions::stop or afterPass
  /// Samples whose paths were under way when the run was to stop and did not end soon: not on the film.
  std::uint64_t samplesAbandoned = 0;
  std::uint64_t pixelsTotal = 0, pixelsSampled = 0;  ///< the latter have a sample at least
  /// The first in order of pixel (row by row), then sample; each at most RenderOptions::maxRecords.
  std::vector<DroppedSample> dropped;
  std::vector<MediumMismatch> mismatches;
  std::vector<ViolationRecord> violations;
  std::vector<LearningRecord> learning;  ///< one for each of the scene's learners
  /// What the integrator's next pass has to know of those before besides the film. Mostly nothing.
  std::vector<double> carried;
};

}  // namespace pbrtmedia
