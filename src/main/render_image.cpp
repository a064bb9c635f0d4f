// SPDX-License-Identifier: BSD-2-Clause
#include "main/render_image.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/byte_stream.h"
#include "base/parallel.h"
#include "main/convergence.h"
#include "main/image_error.h"
#include "main/progress.h"
#include "render/integrator.h"
#include "render/render_options.h"

namespace pbrtmedia {
namespace {

/// What looks at the image after passes: whether it is good enough, and how good it is.
class Measuring {
 public:
  /// `isWanted`: false where somebody else measures.
  Measuring(const Construction& scene, const Options& options, Watching& watching, bool isWanted) {
    if (!isWanted) return;
    Film& film = *scene.film;
    const Bounds2i pixels =
        scene.pixelBounds ? intersect(film.pixelBounds(), *scene.pixelBounds) : film.pixelBounds();
    if (options.mostError) target_.emplace(*options.mostError, film, pixels);
    if (!options.convergence) return;
    ConvergenceLog::Params log{
        .file = *options.convergence, .pixels = pixels, .command = options.commandLine};
    if (options.reference) log.reference = readImage(*options.reference);
    if (watching.isOn()) {
      log.onRow = [&watching](const ErrorRow& row) { watching.addError(row); };
    }
    log_.emplace(log, film);
  }

  bool isNeeded() const { return target_ || log_; }
  /// Whether to go on.
  bool afterPass(const PassEnd& end, const StopSignal& stop) {
    const Stopwatch watch;
    const bool isRowDue = log_ && log_->isDue(end.result), isLookDue = target_ && target_->isDue(end.result);
    if (isRowDue || isLookDue) end.bringFilm();
    if (isRowDue) log_->afterPass(end.result);
    isGoodEnough_ = isLookDue && target_->isReached(end.result);
    time_ += watch.elapsed();
    stop.extend(watch.seconds());
    return !isGoodEnough_;
  }
  void finish(const RenderResult& result) {
    const Stopwatch watch;
    if (log_) log_->finish(result);
    time_ += watch.elapsed();
  }
  bool isGoodEnough() const { return isGoodEnough_; }
  const PhaseTime& time() const { return time_; }

 private:
  std::optional<ErrorTarget> target_;
  std::optional<ConvergenceLog> log_;
  bool isGoodEnough_ = false;
  PhaseTime time_;
};

std::string nameOf(EarlyStop stop, bool isGoodEnough) {
  switch (stop) {
    case EarlyStop::None:
      return "";
    case EarlyStop::Time:
      return "time";
    case EarlyStop::Lookups:
      return "lookups";
    case EarlyStop::Asked:
      break;
  }
  if (isGoodEnough) return "error";
  return interruption::requested == StopCause::Time ? "time" : "signal";
}

/// What the ranks did since `before`. Called by all; answers it on the first.
std::vector<RankShare> sharesOf(Ranks& ranks, const RankTraffic& before, double cpu, std::uint64_t passes) {
  if (ranks.isAlone()) return {};
  const RankTraffic& now = ranks.traffic();
  ByteWriter out;
  out.add(static_cast<std::uint64_t>(threadCount()));
  out.add(cpu);
  out.add(passes);
  out.add(now.bytes - before.bytes);
  out.add(now.messages - before.messages);
  out.add(now.waiting - before.waiting);
  out.add(now.moving - before.moving);
  std::vector<RankShare> shares;
  for (const std::string& text : ranks.gather(out.text())) {
    ByteReader in(text);
    RankShare& share = shares.emplace_back();
    share.threads = static_cast<unsigned>(in.number<std::uint64_t>());
    share.cpu = in.number<double>();
    share.passes = in.number<std::uint64_t>();
    share.traffic.bytes = in.number<std::uint64_t>();
    share.traffic.messages = in.number<std::uint64_t>();
    share.traffic.waiting = in.number<double>();
    share.traffic.moving = in.number<double>();
  }
  return shares;
}

}  // namespace

bool needsHalves(const Options& options) {
  return options.mostError || (options.convergence && !options.reference);
}

RenderedImage renderImage(const Construction& scene, const Options& options, const Ending& ending,
                          Watching& watching, Checkpoints& checkpoints, const Together& together) {
  RenderOptions loop;
  loop.seed = options.seed;
  loop.tileSize = options.tileSize;
  loop.pixelBounds = scene.pixelBounds;
  loop.stop = &ending.stop.flag();
  if (options.samples) {
    loop.firstSample = options.samples->first;
    loop.endSample = options.samples->end;
    loop.learnsBounds = false;
  }
  if (options.mostLookups) loop.mostLookups = static_cast<std::uint64_t>(*options.mostLookups);
  Ranks& ranks = together.ranks();
  loop.ranks = &ranks;
  loop.limitSeconds = [&](double seconds) { ending.stop.endIn(seconds + kLateness); };
  loop.secondsLeft = [&] { return ending.stop.secondsLeft(); };
  const RankTraffic before = ranks.traffic();
  const Stopwatch rendering;
  Measuring measuring(scene, options, watching, ranks.isFirst());
  if (measuring.isNeeded()) loop.mostGrowth = ConvergenceLog::mostGrowth();
  if (watching.isOn()) loop.mostSecondsPerPass = Watching::kMostSecondsPerPass;
  if (measuring.isNeeded() || watching.isOn()) {
    loop.afterPass = [&](const PassEnd& end) {
      if (watching.isOn()) watching.afterPass(end, *scene.film);
      return measuring.afterPass(end, ending.stop);
    };
  }
  const double timeLeft = options.timeLimit ? *options.timeLimit - ending.sinceStart.seconds() : 0;
  ProgressLine line(options.progress, options.quiet, scene.outfile.filename().string());
  loop.progress = [&](const RenderProgress& p) {
    line.update(static_cast<std::int64_t>(p.samplesDone), static_cast<std::int64_t>(p.samplesTotal),
                std::max(0.0, timeLeft));
    watching.update(p, std::max(0.0, timeLeft));
  };
  checkpoints.attach(scene, loop);
  RenderedImage rendered;
  if (std::vector<SideImage> sides = scene.integrator->sideImages(); !sides.empty())
    loop.sides = &rendered.sides.emplace(std::move(sides), scene.film->settings().resolution);
  rendered.result = scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, loop);
  line.finish(static_cast<std::int64_t>(rendered.result.samplesTaken),
              static_cast<std::int64_t>(rendered.result.samplesTotal));
  measuring.finish(rendered.result);
  rendered.measuring = measuring.time();
  rendered.stoppedBy = nameOf(rendered.result.stoppedBy, measuring.isGoodEnough());
  rendered.ranks = sharesOf(ranks, before, rendering.elapsed().cpu, rendered.result.passes);
  return rendered;
}

}  // namespace pbrtmedia
