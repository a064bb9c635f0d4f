// SPDX-License-Identifier: BSD-2-Clause
#include "main/render.h"

#include <cstdlib>
#include <iostream>
#include <optional>
#include <sstream>

#include "base/diagnostics.h"
#include "base/interruption.h"
#include "base/parallel.h"
#include "base/run_program.h"
#include "base/stop_signal.h"
#include "base/stopwatch.h"
#include "image/image.h"
#include "main/derivative.h"
#include "main/frames.h"
#include "main/kept_bounds.h"
#include "main/messages.h"
#include "main/output_files.h"
#include "main/progress.h"
#include "main/render_world.h"
#include "main/statistics_report.h"
#include "main/watching.h"
#include "scene/param_text.h"
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
  Diagnostics unseen;  // what is asked of media prints nothing, but may use variables
  parseParams(options.mediumParams, "--mediumparams", print.variables, unseen);
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

/// What is to be rendered.
struct Input {
  ParamList mediumParams;  ///< those of --mediumparams
  std::vector<SceneDescription> worlds;
};

/// What is wrong with the worlds of a scene all together.
void checkWorlds(const Input& input, const Options& options, Diagnostics& diagnostics) {
  const std::vector<SceneDescription>& worlds = input.worlds;
  if (worlds.empty() && !diagnostics.hasErrors()) {
    diagnostics.error({}, "no WorldBegin … WorldEnd block in " + sceneNames(options) + ": nothing to render");
  }
  if (options.convergence && worlds.size() > 1) {
    diagnostics.error({}, "--convergence is of one image, and there are " + std::to_string(worlds.size()) +
                              " WorldBegin … WorldEnd blocks; render them apart");
  }
  if (options.derivative && worlds.size() > 1) {
    diagnostics.error({}, "--derivative is of one image, and there are " + std::to_string(worlds.size()) +
                              " WorldBegin … WorldEnd blocks; render them apart");
  }
  reportSharedOutputs(worlds, options, diagnostics);
  reportSharedStrategyImages(worlds, options, diagnostics);
  reportLostFiles(worlds, input.mediumParams, options, diagnostics);
}

/// How a run ended.
struct Outcome {
  int status = 0;
  bool isStopped = false;  ///< by a signal or a limit, before the end
};

/// Reads options and scene files. Shows what is wrong with them; throws ShownFailure when that makes them
/// useless.
Input readInput(const Options& options, Watching& watching) {
  Diagnostics diagnostics;
  diagnostics.strict = options.strict;
  Input input;
  std::vector<SceneDescription>& worlds = input.worlds;
  Variables variables = options.variables;
  input.mediumParams = parseParams(options.mediumParams, "--mediumparams", variables, diagnostics);
  try {
    const PhaseLine line(options.progress, options.quiet, "reading " + sceneNames(options));
    worlds = parseFiles(options.scenes, diagnostics, {.variables = variables});
  } catch (const Interrupted&) {
    show(diagnostics, options.quiet);
    throw;
  }
  checkWorlds(input, options, diagnostics);
  show(diagnostics, options.quiet);
  watching.add(diagnostics);
  if (diagnostics.hasErrors()) throw ShownFailure(diagnostics.format());
  return input;
}

/// What cannot be shared out. Throws SceneError, on all ranks alike.
void checkShareable(const Options& options) {
  if (options.derivative) {
    throw SceneError(
        {},
        "--derivative: several processes cannot share the passes of a derivative; render it with "
        "one, or with other seeds on each machine, and imgtool merge takes the mean");
  }
  for (const auto& scene : options.scenes) {
    if (scene == "-") {
      throw SceneError({},
                       "several processes cannot read one standard input; write the scene to a file, which "
                       "all of them can read");
    }
  }
}

Outcome renderScenes(const Options& given, Together& together) {
  const Options options = together.step([&] {
    if (!together.ranks().isAlone()) checkShareable(given);
    return atItsValue(together.isFirst() ? given : optionsOfOthers(given));
  });
  std::optional<Checkpoints> checkpoints;
  together.step([&] {
    if (together.isFirst()) checkFiles(options);
    checkpoints.emplace(options, together.isFirst());
  });
  const ThreadLimit threads(options.threads);
  const StopSignal stop({.notice = together.isFirst() ? kNothingYet : nullptr,
                         .timeLimit = options.timeLimit.value_or(StopSignal::kNever),
                         .abandonsPaths = true});
  const Ending ending{stop, Stopwatch()};
  Watching watching(options);

  const Stopwatch parsing;
  Input input;
  try {
    input = together.step([&] { return readInput(options, watching); });
  } catch (const ShownFailure&) {
    return {kExitBadInput};
  } catch (const Interrupted& stopped) {
    return {reportNoImage(stopped, options, ending, "while the scene was read"),
            stopped.cause() != StopCause::Time};
  }
  const PhaseTime parseTime = parsing.elapsed();
  std::vector<SceneDescription>& worlds = input.worlds;

  std::optional<KeptBounds> bounds;
  const std::size_t first = together.step([&] {
    bounds.emplace(options.boundsCache);
    return checkpoints->firstWorld(worlds.size());
  });
  const Run run{options, ending, watching, *bounds, *checkpoints, together, input.mediumParams};
  int status = 0;
  bool isStopped = false, isOver = false;
  std::vector<RenderStatistics> all;
  if (first > 0 && !options.quiet)
    std::cerr << "pbrt: note: going on with world " << first + 1
              << "; the images of those before are written\n";
  for (std::size_t number = first; number < worlds.size() && !isOver; ++number) {
    if (together.isFirst()) StopSignal::say(kNothingYet);
    try {
      const std::optional<RenderStatistics> one =
          renderWorld(worlds[number], {number, worldName(options, number)}, run,
                      all.empty() ? parseTime : PhaseTime{}, status);
      if (!one) break;
      all.push_back(*one);
      checkpoints->leave(statisticsText(*one));
      isOver = one->interrupted && stop;
      isStopped = isOver && one->stoppedBy == "signal";
    } catch (const Interrupted& stopped) {
      const std::string which = worlds.size() > 1 ? " of world " + std::to_string(number + 1) : "";
      status = reportNoImage(stopped, options, ending, "before the first sample" + which);
      isStopped = stopped.cause() == StopCause::Signal;
      isOver = true;
    }
    isOver = together.decide(isOver ? 1 : 0) == 1;
    if (isOver && number + 1 < worlds.size() && !options.quiet) {
      std::cerr << "pbrt: warning: stopped: " << worlds.size() - number - 1 << " of " << worlds.size()
                << " worlds are not rendered\n";
    }
  }
  if (options.statsFile && !all.empty()) writeStatistics(*options.statsFile, checkpoints->worldsDone());
  // Also one that came too late for this scene ends what would follow.
  isStopped = isStopped || interruption::requested == StopCause::Signal;
  return {together.decide(status), isStopped};
}

void tell(const SceneError& e) {
  if (e.location().file == nullptr) {
    std::cerr << "pbrt: error: " << e.what() << '\n';
    return;
  }
  Diagnostics diagnostics;  // with its excerpt, as those that were collected
  diagnostics.add(e);
  std::cerr << diagnostics.format();
}

/// What fails in a frame is told, and is its status. Several ranks all leave where one fails.
Outcome renderFrame(const Options& options, Together& together) {
  if (!together.ranks().isAlone()) return renderScenes(options, together);
  try {
    return renderScenes(options, together);
  } catch (const SceneError& e) {
    tell(e);
  } catch (const std::exception& e) {
    std::cerr << "pbrt: error: " << e.what() << '\n';
  }
  return {kExitBadInput};
}

/// One after the other; a problem of one does not keep the others, unless several ranks have it.
int renderFrames(const Options& options, Together& together) {
  together.step([&] { checkFrames(options); });
  const FrameRange& frames = *options.frames;
  int status = 0;
  for (int frame = frames.first; frame <= frames.last; frame += frames.step) {
    if (!options.quiet)
      std::cerr << "pbrt: frame " << frame << " of " << frames.first << " to " << frames.last << '\n';
    const Outcome one = renderFrame(optionsOfFrame(options, frame), together);
    status = worseStatus(status, one.status);
    if (together.hasFailed() || frame > frames.last - frames.step) break;
    if (together.decide(one.isStopped ? 1 : 0) == 1) break;
  }
  return status;
}

}  // namespace

int runPbrt(const Options& options, Together& together) {
  if (options.cat || options.toPly) {
    if (!together.isFirst()) return together.decide(0);
    return together.decide(
        printScenes(options.frames ? optionsOfFrame(options, options.frames->first) : options));
  }
  return options.frames ? renderFrames(options, together) : renderScenes(options, together).status;
}

int runPbrtProgram(const Options& options, Together& together) {
  return runProgram("pbrt", [&] {
    try {
      const int status = runPbrt(options, together);
      together.noteEnd();
      return status;
    } catch (const SceneError& e) {
      tell(e);
      return kExitBadInput;
    }
  });
}

}  // namespace pbrtmedia
