// SPDX-License-Identifier: BSD-2-Clause
#include "render/pass_loop.h"

#include <algorithm>
#include <utility>

#include "render/render_state.h"

namespace pbrtmedia {
namespace {

constexpr double kProgressInterval = 0.1;  // seconds

}  // namespace

RenderResult PassLoop::resultAtStart(const RenderOptions& options, const Plan& plan) {
  RenderResult result;
  if (options.start) result = options.start->result;
  result.stoppedBy = EarlyStop::None;
  result.samplesTotal = plan.samplesPerIndex *
                        static_cast<std::uint64_t>(std::max<std::int64_t>(plan.end - options.firstSample, 0));
  result.pixelsTotal = plan.pixels;
  if (!options.start) result.completedSamplesPerPixel = options.firstSample;
  return result;
}

PassLoop::PassLoop(const Scene& scene, const RenderOptions& options, const Plan& plan)
    : options_(options),
      plan_(plan),
      result_(resultAtStart(options, plan)),
      learning_(scene, !options.learnsBounds, result_),
      timeBefore_{result_.seconds, result_.cpuSeconds},
      schedule_({.first = result_.completedSamplesPerPixel,
                 .end = plan.samplesPerIndex > 0 ? plan.end : 0,
                 .mostPerPass = learning_.isNeeded() ? 1 : plan.mostPerPass},
                options),
      samplesDone_(result_.samplesTaken) {}

RenderResult PassLoop::run(const TakeSamples& takeSamples, const AddToFilm& addToFilm) {
  if (result_.samplesTotal > 0) learning_.warmUp(options_.seed, [this] { return shouldStop(); });
  while (const std::optional<Pass> pass = schedule_.next(result_.counters.densityLookups)) {
    const std::vector<UnitReport> units = takeSamples(*pass);
    if (options_.beforePartialPass && !areComplete(units)) {
      goesOn([&](const PassEnd& end) {
        options_.beforePartialPass(end);
        return false;
      });
    }
    addToFilm(units);
    const std::uint64_t samplesBefore = result_.samplesTaken;
    addReports(units, pass->first == options_.firstSample, options_.maxRecords, result_);
    learning_.publish(result_.samplesTaken - samplesBefore);
    if (!areComplete(units)) break;
    result_.completedSamplesPerPixel = pass->first + pass->count;
    if (options_.afterPass && !goesOn(options_.afterPass)) break;
  }
  if (plan_.samplesPerIndex == 0)
    result_.completedSamplesPerPixel = std::max(plan_.end, options_.firstSample);
  result_.interrupted = result_.samplesTaken < result_.samplesTotal;
  if (result_.interrupted) {
    result_.stoppedBy = schedule_.reasonToStop(result_.counters.densityLookups);
    if (result_.stoppedBy == EarlyStop::None) result_.stoppedBy = EarlyStop::Asked;
  }
  noteTime();
  return std::move(result_);
}

bool PassLoop::goesOn(const std::function<bool(const PassEnd&)>& ask) {
  noteTime();
  const Stopwatch hook;
  const bool answer = ask({progress(), result_});
  schedule_.leaveOut(hook.elapsed());
  return answer;
}

void PassLoop::noteTime() {
  const PhaseTime time = schedule_.time();
  result_.seconds = timeBefore_.wall + time.wall;
  result_.cpuSeconds = timeBefore_.cpu + time.cpu;
}

RenderProgress PassLoop::progress() const {
  return {samplesDone_.load(std::memory_order_relaxed), result_.samplesTotal,
          timeBefore_.wall + schedule_.seconds()};
}

void PassLoop::reportProgress() {
  if (!options_.progress) return;
  const std::unique_lock<std::mutex> lock(progressMutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const RenderProgress now = progress();
  if (now.seconds - lastReport_ < kProgressInterval) return;
  lastReport_ = now.seconds;
  options_.progress(now);
}

}  // namespace pbrtmedia
