// SPDX-License-Identifier: BSD-2-Clause
#include "main/render.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "base/stop_signal.h"
#include "base/stopwatch.h"
#include "construct/construct.h"
#include "construct/scene_identity.h"
#include "image/image.h"
#include "main/kept_bounds.h"
#include "main/output_files.h"
#include "main/progress.h"
#include "main/statistics_report.h"
#include "main/warnings.h"
#include "main/watching.h"
#include "render/integrator.h"
#include "render/render_options.h"
#include "scene/param_text.h"
#include "scene/parser.h"
#include "scene/print.h"
#include "tools/build_info.h"

namespace pbrtmedia {
namespace {

constexpr int kExitBadInput = 1;  // or an image that is not where it should be
constexpr int kExitStrict = 2;

/// Messages that begin with no place begin with the program's name.
std::string named(const std::string& messages) {
  std::string text;
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);) {
    for (const char* severity : {"error: ", "warning: ", "note: "}) {
      if (line.starts_with(severity)) text += "pbrt: ";
    }
    text += line + '\n';
  }
  return text;
}

/// Prints what has been collected; warnings and notes only when not --quiet.
void show(const Diagnostics& diagnostics, bool quiet) {
  if (!quiet) {
    std::cerr << named(diagnostics.format());
    return;
  }
  Diagnostics errors;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::Error) errors.add(d.severity, d.location, d.message);
  }
  std::cerr << named(errors.format());
}

std::string sceneNames(const Options& options) {
  std::string names;
  for (const auto& scene : options.scenes) {
    if (!names.empty()) names += ' ';
    names += scene.string();
  }
  return names;
}

int printScenes(const Options& options) {
  Diagnostics diagnostics;
  diagnostics.strict = options.strict;
  PrintOptions print;
  print.meshesToPly = options.toPly;
  if (const char* prefix = std::getenv("PLY_PREFIX")) print.plyPrefix = prefix;
  printFiles(options.scenes, std::cout, diagnostics, print);
  std::cout.flush();
  show(diagnostics, options.quiet);
  return diagnostics.hasErrors() ? kExitBadInput : 0;
}

/// Samples per pixel that the image holds: a mean when it was stopped early.
std::string samplesPerPixelText(const RenderStatistics& s) {
  if (!s.interrupted || s.samplesPlanned == 0) return std::to_string(s.samplesPerPixel);
  std::ostringstream mean;
  mean << static_cast<double>(s.samplesTaken) / static_cast<double>(s.samplesPlanned) *
              static_cast<double>(s.samplesPerPixel);
  return mean.str();
}

std::string hexadecimal(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << value;
  return text.str();
}

/// "sceneHash" says whether renders may be merged, the others what differs where they may not.
void addIdentity(Image& image, const SceneIdentity& identity) {
  image.metadata["sceneHash"] = hexadecimal(identity.hash());
  image.metadata["sceneText"] = hexadecimal(identity.text);
  if (!identity.mediumParams.empty()) image.metadata["mediumParams"] = identity.mediumParams;
  // A header is no place for thousands of names.
  constexpr std::size_t kMostFiles = 64;
  std::string files;
  for (std::size_t i = 0; i < identity.files.size() && i < kMostFiles; ++i) {
    if (i > 0) files += '\n';
    files += hexadecimal(identity.files[i].content) + ' ' + identity.files[i].name;
  }
  if (!files.empty()) image.metadata["sceneFiles"] = files;
}

Image withHeader(Image image, const RenderStatistics& statistics, const Options& options,
                 const SceneIdentity& identity) {
  std::ostringstream seconds;
  seconds << statistics.render.wall;
  image.metadata["command"] = options.commandLine;
  image.metadata["version"] = buildText();
  image.metadata["seed"] = std::to_string(options.seed);
  image.metadata["samples"] = samplesPerPixelText(statistics);
  image.metadata["seconds"] = seconds.str();
  addIdentity(image, identity);
  const std::string bounds = boundsState(statistics.learning);
  if (!bounds.empty()) image.metadata["boundsState"] = bounds;
  return image;
}

constexpr const char* kNothingYet =
    "\nstopping before the first sample: there is no image (again to end at once)\n";
constexpr const char* kImageSoFar = "\nstopping; the image so far will be written (again to end at once)\n";

/// When and why a run ends early.
struct Ending {
  const StopSignal& stop;
  Stopwatch sinceStart;  ///< of the program
};

/// A run that was stopped before there was anything to write.
int reportNoImage(const Interrupted& stopped, const Options& options, const Ending& ending,
                  const std::string& when) {
  std::cerr << "pbrt: error: ";
  if (stopped.cause() == StopCause::Time) std::cerr << "--time " << options.timeLimit.value_or(0) << ": ";
  std::cerr << "stopped after " << formatDuration(ending.sinceStart.seconds()) << ", " << when
            << "; no image is written\n";
  return kExitBadInput;
}

RenderResult renderImage(const Construction& scene, const Options& options, const Ending& ending,
                         Watching& watching) {
  RenderOptions loop;
  loop.seed = options.seed;
  loop.tileSize = options.tileSize;
  loop.pixelBounds = scene.pixelBounds;
  loop.stop = &ending.stop.flag();
  const double timeLeft = options.timeLimit ? *options.timeLimit - ending.sinceStart.seconds() : 0;
  ProgressLine line(options.progress, options.quiet, scene.outfile.filename().string());
  loop.progress = [&](const RenderProgress& p) {
    line.update(static_cast<std::int64_t>(p.samplesDone), static_cast<std::int64_t>(p.samplesTotal),
                std::max(0.0, timeLeft));
    watching.update(p, std::max(0.0, timeLeft));
  };
  if (watching.isOn()) {
    loop.afterPass = [&](const PassEnd& pass) {
      watching.afterPass(pass, *scene.film);
      return true;
    };
  }
  RenderResult result = scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, loop);
  line.finish(static_cast<std::int64_t>(result.samplesTaken), static_cast<std::int64_t>(result.samplesTotal));
  return result;
}

/// Writes what was rendered, a PNG beside it if that is wanted, and says where the files are: "wrote a.exr".
/// Sets `status` when an image is not where it should be.
std::string writeRendered(const std::filesystem::path& outfile, const Image& image, const Options& options,
                          int& status) {
  std::vector<std::filesystem::path> wanted = {outfile};
  if (options.png && outfile.extension() != ".png") {
    wanted.push_back(outfile);
    wanted.back().replace_extension(".png");
  }
  std::string written;
  for (const std::filesystem::path& file : wanted) {
    const SavedImage saved = saveImage(file, image, options.write);
    if (!saved.problem.empty()) {
      std::cerr << "pbrt: error: " << saved.problem << "; the image is in \"" << saved.file.string()
                << "\" instead\n";
      status = kExitBadInput;
    }
    written += (written.empty() ? "" : " and ") + saved.file.string();
  }
  if (!options.quiet) std::cerr << "wrote " << written << '\n';
  return "wrote " + written;
}

/// What a cache calls the world: names of files without folders, and its number among their worlds.
std::string worldName(const Options& options, std::size_t number) {
  std::string name;
  for (const auto& scene : options.scenes) name += scene.filename().string() + ' ';
  return name + '#' + std::to_string(number);
}

/// One world: build, render, write. Sets `status` and returns the numbers; nothing for a world that cannot be
/// built.
std::optional<RenderStatistics> renderWorld(SceneDescription& description, const std::string& name,
                                            const Options& options, const PhaseTime& parseTime,
                                            const Ending& ending, Watching& watching, KeptBounds& bounds,
                                            int& status) {
  RenderStatistics statistics;
  statistics.scene = sceneNames(options);
  statistics.seed = options.seed;
  statistics.threads = threadCount();
  statistics.parse = parseTime;

  const Stopwatch constructing;
  Diagnostics diagnostics;
  diagnostics.strict = options.strict;
  const ConstructOptions build{
      .outfile = options.outfile,
      .cropWindow = options.cropWindow,
      .quick = options.quick,
      .samplesPerPixel = options.samplesPerPixel,
      .seed = options.seed,
      .mediumParams = parseParams(options.mediumParams, "--mediumparams", diagnostics)};
  if (diagnostics.hasErrors()) {
    show(diagnostics, options.quiet);
    status = kExitBadInput;
    return std::nullopt;
  }
  SceneIdentity identity;
  watching.enter("building");
  std::optional<Construction> scene = [&] {
    const PhaseLine line(options.progress, options.quiet, "building " + sceneNames(options));
    identity = identify(description, options.mediumParams, build.mediumParams);
    return construct(description, build, diagnostics);
  }();
  show(diagnostics, options.quiet);
  watching.add(diagnostics);
  if (!scene) {
    status = kExitBadInput;
    return std::nullopt;
  }
  description = {};  // what was not taken is not needed any more
  statistics.construct = constructing.elapsed();
  statistics.outfile = scene->outfile.string();
  statistics.samplesPerPixel = scene->sampler->samplesPerPixel();
  if (options.verbose) {
    for (const std::string& line : scene->report) std::cerr << "  " << line << '\n';
  }

  const std::string boundsWarnings = bounds.restore(name, *scene->scene);
  if (!options.quiet) std::cerr << boundsWarnings;

  StopSignal::say(kImageSoFar);
  watching.begin(statistics.outfile, statistics.samplesPerPixel);
  const Stopwatch rendering;
  const RenderResult result = renderImage(*scene, options, ending, watching);
  statistics.render = rendering.elapsed();
  statistics.samplesTaken = static_cast<std::int64_t>(result.samplesTaken);
  statistics.samplesPlanned = static_cast<std::int64_t>(result.samplesTotal);
  statistics.interrupted = result.interrupted;
  statistics.counters = result.counters;
  statistics.learning = result.learning;

  if (result.samplesTaken == 0 && result.interrupted) leaveIfStopped();  // black would be a wrong image
  const Stopwatch writing;
  watching.enter("writing");
  const Image image = withHeader(scene->film->develop(), statistics, options, identity);
  const std::string written = writeRendered(scene->outfile, image, options, status);
  bounds.save(name, *scene->scene);
  statistics.write = writing.elapsed();
  statistics.peakMemory = peakMemoryBytes();

  if (!options.quiet) std::cerr << describeStop(result);
  const std::string faults = describeFaults(result, options, scene->scene.get());
  std::cerr << faults;
  watching.warn(faults);
  watching.finish(image, result, written);
  if (!options.quiet) std::cerr << describeRisingBounds(result.learning) << describeComplaints(*scene->scene);
  if (!options.quiet) std::cerr << formatStatistics(statistics);
  const bool isFaulty = result.counters.droppedTotal() > 0 || result.counters.boundViolations > 0;
  if (options.strict && isFaulty && status == 0) status = kExitStrict;
  return statistics;
}

}  // namespace

int runPbrt(const Options& options) {
  if (options.cat || options.toPly) return printScenes(options);
  if (options.statsFile) requireWritable("--stats", *options.statsFile);
  if (options.boundsCache) requireWritable("--bounds-cache", *options.boundsCache);
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
    worlds = parseFiles(options.scenes, diagnostics);
  } catch (const Interrupted& stopped) {
    show(diagnostics, options.quiet);
    return reportNoImage(stopped, options, ending, "while the scene was read");
  }
  const PhaseTime parseTime = parsing.elapsed();
  if (worlds.empty() && !diagnostics.hasErrors()) {
    diagnostics.error({}, "no WorldBegin … WorldEnd block in " + sceneNames(options) + ": nothing to render");
  }
  reportSharedOutputs(worlds, options, diagnostics);
  show(diagnostics, options.quiet);
  watching.add(diagnostics);
  if (diagnostics.hasErrors()) return kExitBadInput;

  KeptBounds bounds(options.boundsCache);
  int status = 0;
  std::vector<RenderStatistics> all;
  for (SceneDescription& world : worlds) {
    StopSignal::say(kNothingYet);
    try {
      const std::optional<RenderStatistics> one =
          renderWorld(world, worldName(options, all.size()), options, all.empty() ? parseTime : PhaseTime{},
                      ending, watching, bounds, status);
      if (!one) return status;
      all.push_back(*one);
    } catch (const Interrupted& stopped) {
      const std::string which = worlds.size() > 1 ? " of world " + std::to_string(all.size() + 1) : "";
      status = reportNoImage(stopped, options, ending, "before the first sample" + which);
      break;
    }
    if (all.back().interrupted) break;
  }
  if (options.statsFile && !all.empty()) writeStatistics(*options.statsFile, all);
  return status;
}

}  // namespace pbrtmedia
