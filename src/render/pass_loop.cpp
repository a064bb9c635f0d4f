// SPDX-License-Identifier: BSD-2-Clause
#include "render/pass_loop.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/byte_stream.h"
#include "base/diagnostics.h"
#include "render/render_state.h"

namespace pbrtmedia {
namespace {

constexpr double kProgressInterval = 0.1;  // seconds

}  // namespace

RenderResult PassLoop::resultAtStart(const RenderOptions& options, const Plan& plan) {
  RenderResult result;
  if (options.start) result = options.start->result;
  result.passes = 0;
  result.stoppedBy = EarlyStop::None;
  result.samplesTotal = plan.samplesPerIndex *
                        static_cast<std::uint64_t>(std::max<std::int64_t>(plan.end - options.firstSample, 0));
  result.pixelsTotal = plan.pixels;
  if (!options.start) result.completedSamplesPerPixel = options.firstSample;
  return result;
}

PassLoop::PassLoop(const Scene& scene, const RenderOptions& options, const Plan& plan)
    : scene_(scene),
      options_(options),
      ranks_(options.ranks ? *options.ranks : oneRank()),
      plan_(plan),
      result_(resultAtStart(options, plan)),
      learning_(scene, !options.learnsBounds, ranks_, result_),
      timeBefore_{result_.seconds, result_.cpuSeconds},
      schedule_({.first = result_.completedSamplesPerPixel,
                 .end = plan.samplesPerIndex > 0 ? plan.end : 0,
                 .mostPerPass = learning_.isNeeded() ? 1 : plan.mostPerPass},
                options),
      samplesDone_(result_.samplesTaken) {}

RenderResult PassLoop::run(const TakeSamples& takeSamples, const AddToFilm& addToFilm,
                           const CollectFilm& collectFilm) {
  if (!ranks_.isAlone() && !collectFilm) {
    throw SceneError({},
                     "the passes of this integrator cannot be shared by several processes; render the scene "
                     "with one, or with parts of its image for each (--cropwindow)");
  }
  collectFilm_ = collectFilm;
  if (result_.samplesTotal > 0) learning_.warmUp(options_.seed, [this] { return shouldStop(); });
  while (const std::optional<Pass> pass = nextPass()) {
    const std::vector<UnitReport> units = takeSamples(*pass);
    const PassReport report = addUpUnits(units, pass->first == options_.firstSample);
    if (!report.isComplete) showBeforePartialPass();
    ++result_.passes;
    samplesOfPass_ = report.taken.samplesTaken;
    addToFilm(units);
    addPass(report.taken, options_.maxRecords, result_);
    samplesDone_ = result_.samplesTaken;
    learning_.publish(samplesOfPass_);
    if (!report.isComplete) break;
    result_.completedSamplesPerPixel = pass->first + pass->count;
    if (ranks_.isFirst() && options_.afterPass) isEnded_ = !goesOn(options_.afterPass);
  }
  if (!ranks_.isAlone()) collectFilm_();
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

void PassLoop::tell(Order::Kind kind, const Pass& pass) {
  if (ranks_.isAlone()) return;
  ByteWriter out;
  out.add(static_cast<std::uint64_t>(kind));
  out.add(static_cast<std::uint64_t>(pass.first));
  out.add(static_cast<std::uint64_t>(pass.count));
  out.add(options_.secondsLeft ? options_.secondsLeft() : std::numeric_limits<double>::infinity());
  std::string text = out.text();
  ranks_.broadcast(text);
}

PassLoop::Order PassLoop::hear() {
  for (;;) {
    std::string text;
    ranks_.broadcast(text);
    ByteReader in(text);
    Order order;
    order.kind = static_cast<Order::Kind>(in.number<std::uint64_t>());
    order.pass.first = static_cast<std::int64_t>(in.number<std::uint64_t>());
    order.pass.count = static_cast<int>(in.number<std::uint64_t>());
    order.secondsLeft = in.number<double>();
    if (order.kind != Order::Kind::BringFilm) return order;
    collectFilm_();
  }
}

std::optional<Pass> PassLoop::nextPass() {
  if (ranks_.isFirst()) {
    const std::optional<Pass> pass =
        isEnded_ ? std::nullopt : schedule_.next(result_.counters.densityLookups);
    tell(pass ? Order::Kind::TakePass : Order::Kind::End, pass.value_or(Pass{}));
    return pass;
  }
  const Order order = hear();
  if (order.kind == Order::Kind::End) return std::nullopt;
  if (options_.limitSeconds) options_.limitSeconds(order.secondsLeft);
  return order.pass;
}

PassReport PassLoop::addUpUnits(std::span<const UnitReport> units, bool isFirstPass) {
  PassReport report;
  addReports(units, isFirstPass, options_.maxRecords, report.taken);
  report.isComplete = areComplete(units);
  const double own = schedule_.time().cpu;
  report.cpuSeconds = own;
  addUp(ranks_, scene_, options_.maxRecords, report);
  cpuOfOthers_ = report.cpuSeconds - own;
  return report;
}

void PassLoop::showBeforePartialPass() {
  if (!ranks_.isFirst()) {
    hear();
    return;
  }
  if (options_.beforePartialPass) {
    goesOn([&](const PassEnd& end) {
      options_.beforePartialPass(end);
      return false;
    });
  }
  tell(Order::Kind::GoOn);
}

bool PassLoop::goesOn(const std::function<bool(const PassEnd&)>& ask) {
  noteTime();
  const Stopwatch hook;
  const bool answer = ask({progress(), result_, [this] {
                             if (ranks_.isAlone()) return;
                             tell(Order::Kind::BringFilm);
                             collectFilm_();
                           }});
  schedule_.leaveOut(hook.elapsed());
  return answer;
}

void PassLoop::noteTime() {
  const PhaseTime time = schedule_.time();
  result_.seconds = timeBefore_.wall + time.wall;
  result_.cpuSeconds = timeBefore_.cpu + time.cpu + cpuOfOthers_;
}

RenderProgress PassLoop::progress() const {
  // Those under way on this rank stand for those on the others too.
  const std::uint64_t counted = samplesDone_.load(std::memory_order_relaxed), before = result_.samplesTaken;
  const std::uint64_t done = counted > before ? before + (counted - before) * ranks_.count() : counted;
  return {std::min(done, result_.samplesTotal), result_.samplesTotal, timeBefore_.wall + schedule_.seconds()};
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
