// SPDX-License-Identifier: BSD-2-Clause
#include "main/watching.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "base/parallel.h"
#include "base/stop_signal.h"
#include "display/change_error.h"
#include "main/progress.h"
#include "tools/build_info.h"

namespace pbrtmedia {
namespace {

constexpr double kLeastInterval = 0.5;  ///< seconds between images
constexpr double kShare = 0.01;         ///< of the time, at most, for making them
/// Samples of an image to those of the one that it is compared with, at least: less change is all noise.
constexpr double kLeastGrowth = 1.2;
constexpr std::size_t kMostWarnings = 50;  ///< that the page shows

std::optional<double> secondsLeft(const RenderProgress& p, double timeLimit) {
  double fraction =
      p.samplesTotal > 0 ? static_cast<double>(p.samplesDone) / static_cast<double>(p.samplesTotal) : 0;
  if (timeLimit > 0) fraction = std::max(fraction, p.seconds / timeLimit);
  if (!(fraction > 0)) return std::nullopt;
  return p.seconds / std::min(fraction, 1.0) - p.seconds;
}

ErrorHistory estimatedErrors() {
  return {{"seconds", "spp", "rmse"}, {}, "estimated from how the image changed"};
}

BoundsStatus statusOf(const LearningRecord& record) {
  const LearningProgress& now = record.passes.empty() ? record.warmUp : record.passes.back();
  return {.medium = record.medium,
          .restored = record.restored,
          .passes = record.passes.size(),
          .cells = now.cells,
          .visited = now.visited,
          .raised = now.raised,
          .largest = now.maximum,
          .shortfall = record.shortfall};
}

}  // namespace

Watching::Watching(const Options& options)
    : isQuiet_(options.quiet),
      isLive_(progressStyle(options.progress, options.quiet) == ProgressStyle::Live),
      pace_(kLeastInterval, kShare) {
  if (!options.displayServer && !options.serve) return;
  feed_ = std::make_unique<Feed>();
  feed_->update([&](RenderStatus& status) {
    for (const auto& scene : options.scenes) {
      if (!status.title.empty()) status.title += ' ';
      status.title += scene.string();
    }
    status.version = buildText();
    status.seed = options.seed;
    status.threads = threadCount();
    status.errors = estimatedErrors();
  });
  try {
    if (options.serve) startServer(options);
    if (options.displayServer) startSender(options);
  } catch (...) {
    feed_->close();
    throw;
  }
}

Watching::~Watching() {
  if (!feed_) return;
  feed_->update([](RenderStatus& status) {
    if (status.phase != "finished" && status.phase != "stopped") status.phase = "failed";
  });
  feed_->close();
  sender_.reset();
  server_.reset();
  printNotes();
}

void Watching::startServer(const Options& options) {
  try {
    server_ = std::make_unique<PageServer>(
        *feed_, PageServer::Params{.at = *options.serve, .isPortFixed = options.isServePortFixed},
        [] { StopSignal::ask(); });
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(std::string("--serve: ") + e.what());
  }
  // The token is nowhere else, so --quiet does not hide it.
  std::cerr << "pbrt: watch it at " << server_->url() << '\n';
}

void Watching::startSender(const Options& options) {
  sender_ = std::make_unique<TevSender>(*feed_, TevSender::Params{.viewer = *options.displayServer},
                                        [this](const std::string& text) { note(text); });
  if (options.strict && !sender_->absence().empty()) {
    throw std::runtime_error("--display-server " + options.displayServer->toString() +
                             ": nobody shows the image there (" + sender_->absence() +
                             "); start the viewer first, or leave out --strict");
  }
  printNotes();
}

void Watching::note(const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    notes_.push_back(text);
  }
  warn("warning: " + text);
}

void Watching::printNotes() {
  std::vector<std::string> notes;
  {
    const std::lock_guard lock(mutex_);
    notes.swap(notes_);
  }
  if (isQuiet_) return;
  for (const std::string& text : notes)
    std::cerr << (isLive_ ? "\r\033[K" : "") << "pbrt: warning: " << text << '\n';
}

void Watching::enter(const std::string& phase) {
  if (!feed_) return;
  feed_->update([&](RenderStatus& status) { status.phase = phase; });
}

void Watching::add(const Diagnostics& diagnostics) {
  if (!feed_) return;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::Note) continue;
    std::string text = d.location.toString();
    if (!text.empty()) text += ": ";
    text += d.severity == Severity::Error ? "error: " : "warning: ";
    warn(text + d.message);
  }
}

void Watching::warn(const std::string& text) {
  if (!feed_ || text.empty()) return;
  feed_->update([&](RenderStatus& status) {
    const bool isThere =
        std::find(status.warnings.begin(), status.warnings.end(), text) != status.warnings.end();
    if (!isThere && status.warnings.size() < kMostWarnings) status.warnings.push_back(text);
  });
}

void Watching::begin(const std::string& outfile, std::int64_t samplesPerPixel) {
  if (!feed_) return;
  // Viewers keep images of earlier runs, for comparison.
  title_ = outfile + " (" + std::to_string(::getpid()) + ')';
  samplesPerPixel_ = samplesPerPixel;
  compared_.reset();
  isMeasured_ = false;
  feed_->update([&](RenderStatus& status) {
    status.phase = "rendering";
    status.outfile = outfile;
    status.samplesPerPixel = samplesPerPixel;
    status.samplesDone = 0;
    status.seconds = 0;
    status.secondsLeft.reset();
    status.errors = estimatedErrors();
    status.bounds.clear();
  });
}

void Watching::update(const RenderProgress& progress, double timeLimit) {
  if (!feed_) return;
  feed_->update([&](RenderStatus& status) {
    status.samplesDone = progress.samplesDone;
    status.samplesTotal = progress.samplesTotal;
    status.seconds = progress.seconds;
    status.secondsLeft = secondsLeft(progress, timeLimit);
  });
  printNotes();
}

void Watching::afterPass(const PassEnd& pass, const Film& film) {
  if (!feed_) return;
  showBounds(pass.result);
  const double start = clock_.seconds();
  if (!feed_->isWatched() || !pace_.isDue(start)) return;
  pass.bringFilm();
  Image image = film.develop();
  const bool isRow = estimateError(image, pass.progress);
  feed_->give(title_, std::move(image));
  if (isRow) compared_ = feed_->latest();
  pace_.done(start, clock_.seconds() - start);
}

double Watching::samplesPerPixelOf(const RenderProgress& p) const {
  return p.samplesTotal > 0 ? static_cast<double>(p.samplesDone) / static_cast<double>(p.samplesTotal) *
                                  static_cast<double>(samplesPerPixel_)
                            : 0;
}

bool Watching::estimateError(const Image& image, const RenderProgress& progress) {
  const double samples = samplesPerPixelOf(progress);
  if (isMeasured_ || (compared_ && samples < kLeastGrowth * comparedSamples_)) return false;
  if (compared_) {
    const std::optional<double> error = errorFromChange(compared_->image, comparedSamples_, image, samples);
    if (error) {
      feed_->update([&](RenderStatus& status) {
        status.errors.rows.push_back({progress.seconds, samples, *error});
      });
    }
  }
  comparedSamples_ = samples;
  return true;
}

void Watching::addError(const ErrorRow& row) {
  if (!feed_) return;
  feed_->update([&](RenderStatus& status) {
    if (!isMeasured_)
      status.errors = {{"seconds", "spp", "mse", "rmse", "relmse", "relmse_robust", "smape"}, {}, ""};
    status.errors.source =
        row.isOfReference ? "against the reference" : "estimated from two halves of the samples";
    const ErrorSummary& e = row.error;
    status.errors.rows.push_back(
        {row.seconds, row.samplesPerPixel, e.mse, e.rmse, e.relativeMse, e.relativeMseRobust, e.smape});
  });
  isMeasured_ = true;
  compared_.reset();
}

void Watching::showBounds(const RenderResult& result) {
  std::vector<BoundsStatus> bounds;
  for (const LearningRecord& record : result.learning) bounds.push_back(statusOf(record));
  feed_->update([&](RenderStatus& status) { status.bounds = std::move(bounds); });
}

void Watching::finish(const Image& image, const RenderResult& result, const std::string& written) {
  if (!feed_) return;
  showBounds(result);
  if (feed_->isWatched()) feed_->give(title_, image);
  feed_->update([&](RenderStatus& status) {
    status.phase = result.interrupted ? "stopped" : "finished";
    status.message = written;
    status.samplesDone = result.samplesTaken;
    status.samplesTotal = result.samplesTotal;
    status.seconds = result.seconds;
    status.secondsLeft = 0;
  });
}

}  // namespace pbrtmedia
