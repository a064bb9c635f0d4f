// SPDX-License-Identifier: BSD-2-Clause
#include "main/render_image.h"

#include <algorithm>
#include <optional>

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
  Measuring(const Construction& scene, const Options& options, Watching& watching) {
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
  bool afterPass(const RenderResult& result, const StopSignal& stop) {
    const Stopwatch watch;
    if (log_) log_->afterPass(result);
    isGoodEnough_ = target_ && target_->isReached(result);
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

}  // namespace

bool needsHalves(const Options& options) {
  return options.mostError || (options.convergence && !options.reference);
}

RenderedImage renderImage(const Construction& scene, const Options& options, const Ending& ending,
                          Watching& watching, Checkpoints& checkpoints) {
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
  Measuring measuring(scene, options, watching);
  if (measuring.isNeeded()) loop.mostGrowth = ConvergenceLog::mostGrowth();
  if (watching.isOn()) loop.mostSecondsPerPass = Watching::kMostSecondsPerPass;
  if (measuring.isNeeded() || watching.isOn()) {
    loop.afterPass = [&](const PassEnd& end) {
      if (watching.isOn()) watching.afterPass(end, *scene.film);
      return measuring.afterPass(end.result, ending.stop);
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
  rendered.result = scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, loop);
  line.finish(static_cast<std::int64_t>(rendered.result.samplesTaken),
              static_cast<std::int64_t>(rendered.result.samplesTotal));
  measuring.finish(rendered.result);
  rendered.measuring = measuring.time();
  rendered.stoppedBy = nameOf(rendered.result.stoppedBy, measuring.isGoodEnough());
  return rendered;
}

}  // namespace pbrtmedia
