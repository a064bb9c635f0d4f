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
  if (options.start) return options.start->result;
  RenderResult result;
  result.samplesTotal = plan.samplesPerIndex *
                        static_cast<std::uint64_t>(std::max<std::int64_t>(plan.end - options.firstSample, 0));
  result.pixelsTotal = plan.pixels;
  result.completedSamplesPerPixel = options.firstSample;
  return result;
}

PassLoop::PassLoop(const Scene& scene, const RenderOptions& options, const Plan& plan)
    : options_(options),
      plan_(plan),
      result_(resultAtStart(options, plan)),
      learning_(scene, result_),
      secondsBefore_(result_.seconds),
      schedule_({.first = result_.completedSamplesPerPixel,
                 .end = plan.samplesPerIndex > 0 ? plan.end : 0,
                 .mostPerPass = learning_.isNeeded() ? 1 : plan.mostPerPass},
                options),
      samplesDone_(result_.samplesTaken) {}

RenderResult PassLoop::run(const RenderPass& renderPass) {
  if (result_.samplesTotal > 0) learning_.warmUp(options_.seed, [this] { return shouldStop(); });
  while (const std::optional<Pass> pass = schedule_.next()) {
    const std::vector<UnitReport> units = renderPass(*pass);
    const std::uint64_t samplesBefore = result_.samplesTaken;
    const bool complete =
        addReports(units, pass->first == options_.firstSample, options_.maxRecords, result_);
    learning_.publish(result_.samplesTaken - samplesBefore);
    if (!complete) break;
    result_.completedSamplesPerPixel = pass->first + pass->count;
    if (!goesOn()) break;
  }
  if (plan_.samplesPerIndex == 0)
    result_.completedSamplesPerPixel = std::max(plan_.end, options_.firstSample);
  result_.interrupted = result_.samplesTaken < result_.samplesTotal;
  result_.seconds = progress().seconds;
  return std::move(result_);
}

bool PassLoop::goesOn() {
  if (!options_.afterPass) return true;
  const RenderProgress now = progress();
  result_.seconds = now.seconds;
  const Stopwatch hook;
  const bool answer = options_.afterPass({now, result_});
  schedule_.leaveOut(hook.seconds());
  return answer;
}

RenderProgress PassLoop::progress() const {
  return {samplesDone_.load(std::memory_order_relaxed), result_.samplesTotal,
          secondsBefore_ + schedule_.seconds()};
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
