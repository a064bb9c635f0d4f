// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "render/bounds_learning.h"
#include "render/pass_report.h"
#include "render/ranks.h"
#include "render/render_options.h"
#include "render/render_result.h"
#include "render/schedule.h"
#include "render/shared_report.h"

namespace pbrtmedia {

/// What all renders have in common, whatever their passes do: bounds are explored before the first pass and
/// published after each, passes follow the schedule until all samples are taken or it is time to stop, their
/// reports are added up, and who wants to know is told how far the render is.
class PassLoop {
 public:
  struct Plan {
    std::int64_t end = 0;               ///< sample indices (iterations, mutations per pixel) below it
    std::uint64_t samplesPerIndex = 0;  ///< usually pixels; 0: nothing is to be taken
    std::uint64_t pixels = 0;           ///< of which each is to get a sample
    std::int64_t mostPerPass = 1;       ///< sample indices that a pass may have
  };
  /// Takes the samples of one pass, and answers what each unit of work reports, in a fixed order. Leaves soon
  /// when shouldStop() says so.
  using TakeSamples = std::function<std::vector<UnitReport>(const Pass&)>;
  /// Adds what was taken last to the film.
  using AddToFilm = std::function<void(std::span<const UnitReport>)>;
  /// Called on all ranks: brings the whole film to the first.
  using CollectFilm = std::function<void()>;

  /// `scene` and `options` must outlive the object.
  PassLoop(const Scene& scene, const RenderOptions& options, const Plan& plan);

  /// Passes that ranks can share take this rank's part of the samples, add what its part of the film is made
  /// of, and have a `collectFilm`. Throws SceneError where there are several ranks and none.
  RenderResult run(const TakeSamples& takeSamples, const AddToFilm& addToFilm,
                   const CollectFilm& collectFilm = {});

  /// For passes. Thread-safe.
  bool shouldStop() const { return schedule_.shouldStop(); }
  /// Samples of the pass that are being added to the film, of all ranks.
  std::uint64_t samplesOfPass() const { return samplesOfPass_; }
  /// Samples that are done, for those who watch. Thread-safe.
  void count(std::uint64_t samples) { samplesDone_.fetch_add(samples, std::memory_order_relaxed); }
  /// RenderResult::carried so far, to be changed when samples are added to the film.
  std::vector<double>& carried() { return result_.carried; }
  /// To be called now and then. Thread-safe.
  void reportProgress();

 private:
  /// What the first rank tells the others.
  struct Order {
    enum class Kind : std::uint64_t { TakePass, BringFilm, GoOn, End } kind = Kind::End;
    Pass pass;
    double secondsLeft = 0;
  };
  void tell(Order::Kind kind, const Pass& pass = {});
  /// The next order but BringFilm, which is done at once.
  Order hear();
  /// The next pass, as the first rank decides.
  std::optional<Pass> nextPass();
  /// What the units report, of all ranks.
  PassReport addUpUnits(std::span<const UnitReport> units, bool isFirstPass);
  /// Before a pass that was left inside is added, the film is looked at on the first rank.
  void showBeforePartialPass();
  static RenderResult resultAtStart(const RenderOptions& options, const Plan& plan);
  /// Seconds of this part and of those before.
  void noteTime();
  RenderProgress progress() const;
  /// Asks somebody outside whether to go on, and leaves the time of that out.
  bool goesOn(const std::function<bool(const PassEnd&)>& ask);

  const Scene& scene_;
  const RenderOptions& options_;
  Ranks& ranks_;
  CollectFilm collectFilm_;
  Plan plan_;
  RenderResult result_;
  BoundsLearning learning_;
  PhaseTime timeBefore_;  ///< of an earlier part of the render
  Schedule schedule_;
  bool isEnded_ = false;    ///< by RenderOptions::afterPass
  double cpuOfOthers_ = 0;  ///< seconds, of the other ranks up to the last pass
  std::uint64_t samplesOfPass_ = 0;
  std::atomic<std::uint64_t> samplesDone_;
  std::mutex progressMutex_;
  double lastReport_ = 0;
};

}  // namespace pbrtmedia
