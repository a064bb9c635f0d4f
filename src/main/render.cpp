// SPDX-License-Identifier: BSD-2-Clause
#include "main/render.h"

#include <cstdlib>
#include <iostream>
#include <sstream>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "base/stop_signal.h"
#include "base/stopwatch.h"
#include "image/image.h"
#include "main/frames.h"
#include "main/kept_bounds.h"
#include "main/messages.h"
#include "main/output_files.h"
#include "main/progress.h"
#include "main/render_world.h"
#include "main/statistics_report.h"
#include "main/watching.h"
#include "scene/parser.h"
#include "scene/print.h"

namespace pbrtmedia {
namespace {

int printScenes(const Options& options) {
  Diagnostics diagnostics;
  diagnostics.strict = options.strict;
  PrintOptions print;
  print.meshesToPly = options.toPly;
  print.variables = options.variables;
  if (const char* prefix = std::getenv("PLY_PREFIX")) print.plyPrefix = prefix;
  printFiles(options.scenes, std::cout, diagnostics, print);
  std::cout.flush();
  show(diagnostics, options.quiet);
  return diagnostics.hasErrors() ? kExitBadInput : 0;
}

/// A run that was stopped before there was anything to write.
int reportNoImage(const Interrupted& stopped, const Options& options, const Ending& ending,
                  const std::string& when) {
  std::cerr << "pbrt: error: ";
  if (stopped.cause() == StopCause::Time) std::cerr << "--time " << options.timeLimit.value_or(0) << ": ";
  std::cerr << "stopped after " << formatDuration(ending.sinceStart.seconds()) << ", " << when
            << "; no image is written\n";
  return kExitBadInput;
}

/// What a cache calls the world: names of files without folders, and its number among their worlds.
std::string worldName(const Options& options, std::size_t number) {
  std::string name;
  for (const auto& scene : options.scenes) name += scene.filename().string() + ' ';
  return name + '#' + std::to_string(number);
}

/// Files that could not be written, or read, in the end: told before hours of work.
void checkFiles(const Options& options) {
  if (options.statsFile) requireWritable("--stats", *options.statsFile);
  if (options.convergence) requireWritable("--convergence", *options.convergence);
  if (options.reference) readImage(*options.reference);
  if (options.boundsCache) requireWritable("--bounds-cache", *options.boundsCache);
  if (options.checkpoint) requireWritable("--checkpoint", *options.checkpoint);
}

/// What is wrong with the worlds of a scene all together.
void checkWorlds(const std::vector<SceneDescription>& worlds, const Options& options,
                 Diagnostics& diagnostics) {
  if (worlds.empty() && !diagnostics.hasErrors()) {
    diagnostics.error({}, "no WorldBegin … WorldEnd block in " + sceneNames(options) + ": nothing to render");
  }
  if (options.convergence && worlds.size() > 1) {
    diagnostics.error({}, "--convergence is of one image, and there are " + std::to_string(worlds.size()) +
                              " WorldBegin … WorldEnd blocks; render them apart");
  }
  reportSharedOutputs(worlds, options, diagnostics);
}

/// How a run ended.
struct Outcome {
  int status = 0;
  bool isStopped = false;  ///< by a signal or a limit, before the end
};

Outcome renderScenes(const Options& options) {
  checkFiles(options);
  Checkpoints checkpoints(options);
  const ThreadLimit threads(options.threads);
  const StopSignal stop({.notice = kNothingYet,
                         .timeLimit = options.timeLimit.value_or(StopSignal::kNever),
                         .abandonsPaths = true});
  const Ending ending{stop, Stopwatch()};
  Watching watching(options);

  const Stopwatch parsing;
  Diagnostics diagnostics;
  diagnostics.strict = options.strict;
  std::vector<SceneDescription> worlds;
  try {
    const PhaseLine line(options.progress, options.quiet, "reading " + sceneNames(options));
    worlds = parseFiles(options.scenes, diagnostics, {.variables = options.variables});
  } catch (const Interrupted& stopped) {
    show(diagnostics, options.quiet);
    return {reportNoImage(stopped, options, ending, "while the scene was read"),
            stopped.cause() != StopCause::Time};
  }
  const PhaseTime parseTime = parsing.elapsed();
  checkWorlds(worlds, options, diagnostics);
  show(diagnostics, options.quiet);
  watching.add(diagnostics);
  if (diagnostics.hasErrors()) return {kExitBadInput};

  KeptBounds bounds(options.boundsCache);
  const Run run{options, ending, watching, bounds, checkpoints};
  int status = 0;
  bool isStopped = false;
  std::vector<RenderStatistics> all;
  const std::size_t first = checkpoints.firstWorld(worlds.size());
  if (first > 0 && !options.quiet)
    std::cerr << "pbrt: note: going on with world " << first + 1
              << "; the images of those before are written\n";
  for (std::size_t number = first; number < worlds.size(); ++number) {
    StopSignal::say(kNothingYet);
    try {
      const std::optional<RenderStatistics> one =
          renderWorld(worlds[number], {number, worldName(options, number)}, run,
                      all.empty() ? parseTime : PhaseTime{}, status);
      if (!one) return {status};
      all.push_back(*one);
      checkpoints.leave(statisticsText(*one));
    } catch (const Interrupted& stopped) {
      const std::string which = worlds.size() > 1 ? " of world " + std::to_string(number + 1) : "";
      status = reportNoImage(stopped, options, ending, "before the first sample" + which);
      isStopped = stopped.cause() == StopCause::Signal;
      break;
    }
    if (all.back().interrupted && stop) {
      isStopped = all.back().stoppedBy == "signal";
      break;
    }
  }
  if (options.statsFile && !all.empty()) writeStatistics(*options.statsFile, checkpoints.worldsDone());
  return {status, isStopped};
}

/// One after the other; a problem of one does not keep the others.
int renderFrames(const Options& options) {
  checkFrames(options);
  const FrameRange& frames = *options.frames;
  int status = 0;
  for (int frame = frames.first; frame <= frames.last; frame += frames.step) {
    if (!options.quiet)
      std::cerr << "pbrt: frame " << frame << " of " << frames.first << " to " << frames.last << '\n';
    const Outcome one = renderScenes(optionsOfFrame(options, frame));
    if (status == 0) status = one.status;
    if (one.isStopped || frame > frames.last - frames.step) break;
  }
  return status;
}

}  // namespace

int runPbrt(const Options& options) {
  if (options.cat || options.toPly) {
    return printScenes(options.frames ? optionsOfFrame(options, options.frames->first) : options);
  }
  return options.frames ? renderFrames(options) : renderScenes(options).status;
}

}  // namespace pbrtmedia
