// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/stopwatch.h"
#include "display/feed.h"
#include "display/pace.h"
#include "display/page_server.h"
#include "display/tev_sender.h"
#include "film/film.h"
#include "main/convergence.h"
#include "main/options.h"
#include "render/render_options.h"
#include "render/render_result.h"

namespace pbrtmedia {

/// `--display-server` and `--serve`: what a run tells those who watch it. Without either option there is
/// neither thread nor feed, and every function returns at once. With them the image so far is made when
/// somebody looks, at most twice a second and for one per cent of the time, and not one bit of the image that
/// is written changes.
class Watching {
 public:
  /// Starts what the options ask for, and prints where the page is. Throws std::runtime_error when the page
  /// cannot be served, and, for --strict, when nobody listens for the image.
  explicit Watching(const Options& options);
  ~Watching();
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

  bool isOn() const { return feed_ != nullptr; }
  /// What a pass may take, so that the image grows often enough.
  static constexpr double kMostSecondsPerPass = 1;

  /// What is done now: "reading", "building", "rendering", "writing".
  void enter(const std::string& phase);
  /// Shows what was found wrong, as it was printed.
  void add(const Diagnostics& diagnostics);
  void warn(const std::string& text);
  /// A world begins to be rendered.
  void begin(const std::string& outfile, std::int64_t samplesPerPixel);
  /// `timeLimit`: seconds for which it may be rendered; 0: any. Prints what the viewer's side has told
  /// meanwhile.
  void update(const RenderProgress& progress, double timeLimit);
  /// After each pass.
  void afterPass(const PassEnd& pass, const Film& film);
  /// An error that was measured: from now on these are shown, and none is estimated.
  void addError(const ErrorRow& row);
  /// The image as it is written; what the file is called.
  void finish(const Image& image, const RenderResult& result, const std::string& written);

 private:
  void startSender(const Options& options);
  void startServer(const Options& options);
  void note(const std::string& text);
  void printNotes();
  void showBounds(const RenderResult& result);
  /// Whether the image has so many samples more than the one that errors were last estimated with that it
  /// takes its place; then adds a row to their history.
  bool estimateError(const Image& image, const RenderProgress& progress);
  double samplesPerPixelOf(const RenderProgress& progress) const;

  bool isQuiet_, isLive_;
  std::mutex mutex_;                ///< of what the sender's thread tells
  std::vector<std::string> notes_;  ///< not printed yet
  std::unique_ptr<Feed> feed_;
  std::unique_ptr<TevSender> sender_;
  std::unique_ptr<PageServer> server_;
  std::string title_;  ///< of the image in viewers
  std::int64_t samplesPerPixel_ = 0;
  Stopwatch clock_;
  Pace pace_;
  std::shared_ptr<const Snapshot> compared_;  ///< the image of the latest row of the history of errors
  double comparedSamples_ = 0;                ///< of its pixels
  bool isMeasured_ = false;                   ///< errors are, so that none need be estimated
};

}  // namespace pbrtmedia
