// SPDX-License-Identifier: BSD-2-Clause
#include "main/render_world.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <vector>

#include "base/built_parts.h"
#include "base/parallel.h"
#include "construct/construct.h"
#include "construct/scene_identity.h"
#include "fields/learned_bounds.h"
#include "image/channels.h"
#include "image/codecs.h"
#include "image/splat_sums.h"
#include "image/weighted_sums.h"
#include "main/derivative.h"
#include "main/image_header.h"
#include "main/messages.h"
#include "main/output_files.h"
#include "main/progress.h"
#include "main/warnings.h"
#include "media/medium.h"
#include "scene/param_text.h"
#include "scene/parser.h"

namespace pbrtmedia {
namespace {

/// A world that is ready, and what its image's header tells of it.
struct BuiltWorld {
  Construction scene;
  SceneIdentity identity;
  std::unique_ptr<DerivativeScenes> derivative;  ///< refers to `scene`
};

ConstructOptions constructOptionsOf(const Options& options, const ParamList& mediumParams) {
  return {.outfile = options.outfile,
          .cropWindow = options.cropWindow,
          .quick = options.quick,
          .samplesPerPixel = options.samplesPerPixel,
          .seed = options.seed,
          .layers = options.layers,
          .mediumParams = mediumParams};
}

/// Throws ShownFailure when there are errors, which are shown.
BuiltWorld build(SceneDescription& description, const Run& run) {
  const Options& options = run.options;
  Diagnostics diagnostics;
  diagnostics.strict = options.strict;
  const ConstructOptions build = constructOptionsOf(options, run.mediumParams);
  SceneIdentity identity;
  run.watching.enter("building");
  std::optional<Construction> scene = [&] {
    const PhaseLine line(options.progress, options.quiet, "building " + sceneNames(options));
    identity = identify(description, build.mediumParams);
    return construct(description, build, diagnostics);
  }();
  show(diagnostics, options.quiet);
  run.watching.add(diagnostics);
  if (!scene) throw ShownFailure(diagnostics.format());
  description = {};  // what was not taken is not needed any more
  if (options.verbose) {
    for (const std::string& line : scene->report) std::cerr << "  " << line << '\n';
  }
  return {std::move(*scene), std::move(identity), nullptr};
}

/// The scene at another value of the variable of --derivative. Throws SceneError with all that is wrong.
Construction buildAt(double value, const Options& options) {
  const std::string& variable = options.derivative->variable;
  Diagnostics diagnostics;
  diagnostics.strict = options.strict;
  ParseOptions parse{.variables = options.variables};
  parse.variables.set(variable, exactText(value));
  const ParamList mediumParams =
      parseParams(options.mediumParams, "--mediumparams", parse.variables, diagnostics);
  std::vector<SceneDescription> worlds = parseFiles(options.scenes, diagnostics, parse);
  std::optional<Construction> scene;
  if (!diagnostics.hasErrors() && worlds.size() == 1)
    scene = construct(worlds.front(), constructOptionsOf(options, mediumParams), diagnostics);
  if (scene) return std::move(*scene);
  throw SceneError({}, "--derivative " + variable + ": there is no scene at " + variable + " = " +
                           exactText(value) + "; take another --step:\n" + diagnostics.format());
}

/// From now on the image of the world is that of its derivative.
void differentiate(BuiltWorld& world, const Run& run) {
  const DerivativeOptions& derivative = *run.options.derivative;
  world.derivative = std::make_unique<DerivativeScenes>(
      world.scene, derivative, [&run](double value) { return buildAt(value, run.options); });
  world.identity.derivative = describe(derivative, world.derivative->samplesPerPass());
}

/// Throws SceneError when the scene has no such samples, or parts of them would not be parts of one image.
void checkRange(const SampleRange& range, const Construction& scene, bool resumes) {
  std::string option = "--samples ";
  option.append(std::to_string(range.first)).append(":").append(std::to_string(range.end)).append(": ");
  const std::int64_t all = scene.sampler->samplesPerPixel();
  if (range.end > all) {
    throw SceneError({}, option + "there are " + std::to_string(all) +
                             " samples of each pixel; --spp gives the number of all, whatever the range");
  }
  if (const std::string why = scene.integrator->whyInOnePiece(); !why.empty())
    throw SceneError({}, option + "the image cannot be rendered in parts: " + why);
  if (formatByExtension(scene.outfile) != ImageFormat::Exr) {
    throw SceneError({},
                     option + "the image must be an EXR file, which holds the sums that imgtool merge adds");
  }
  if (resumes) return;  // bounds are then what they were
  for (Medium* medium : scene.scene->learners()) {
    if (medium->learnedBounds()->isRestored()) continue;
    throw SceneError({},
                     option + "medium \"" + std::string(medium->name()) +
                         "\" learns its bounds while it is rendered, and each range would learn others; let "
                         "one render learn them with --bounds-cache FILE, and give that to all ranges");
  }
}

/// Throws SceneError where images of strategies could not be made.
void checkSideImages(const Construction& scene, const Run& run) {
  if (scene.integrator->sideImages().empty()) return;
  const Options& options = run.options;
  const std::string images = "the images that \"visualizestrategies\" and \"visualizeweights\" make ";
  if (options.checkpoint || options.resume) {
    throw SceneError({},
                     std::string(options.checkpoint ? "--checkpoint" : "--resume") + ": " + images +
                         "are not kept in checkpoints; render them in one go, or leave the parameters out");
  }
  if (options.framesShareFolder) {
    throw SceneError({}, "--frames: " + images +
                             "would be written over those of another frame; write --outfile "
                             "frame-####/image.exr, whose folder is of one frame");
  }
  if (!run.together.ranks().isAlone()) {
    throw SceneError({}, images + "are of one process; render them with pbrt, or leave the parameters out");
  }
}

/// Where the render of a world starts.
void begin(const BuiltWorld& world, const WorldId& id, const Run& run) {
  const Options& options = run.options;
  const Construction& scene = world.scene;
  if (needsHalves(options)) scene.film->keepHalves();
  run.checkpoints.enter(id.number, world.identity, scene);
  if (!run.checkpoints.resumes()) {  // which brings its bounds along
    const std::string boundsWarnings = run.bounds.restore(id.name, *scene.scene);
    if (!options.quiet) std::cerr << boundsWarnings;
  }
  checkSideImages(scene, run);
  if (options.samples) checkRange(*options.samples, scene, run.checkpoints.resumes());
}

/// Writes what was rendered, a PNG beside it if that is wanted, and says where the files are: "wrote a.exr".
/// Sets `status` when an image is not where it should be.
std::string writeRendered(const std::filesystem::path& outfile, const Image& image, const Options& options,
                          int& status) {
  std::vector<std::filesystem::path> wanted = {outfile};
  if (options.png && formatByExtension(outfile) != ImageFormat::Png) {
    wanted.push_back(outfile);
    wanted.back().replace_extension(".png");
  }
  std::string written;
  WriteOptions write = options.write;
  // Viewers would take coverage for transparency.
  const Image colours = wanted.size() > 1 ? withChannels(image, {"R", "G", "B"}) : Image();
  if (options.samples) write.pixelType = PixelType::Float;  // sums are to stay what they are
  for (const std::filesystem::path& file : wanted) {
    const SavedImage saved = saveImage(file, &file == &wanted.front() ? image : colours, write);
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

/// Writes the images besides that of the film into its folder.
void writeSideImages(const std::filesystem::path& outfile, const SideImages& sides,
                     const std::map<std::string, std::string>& metadata, const Options& options,
                     int& status) {
  for (std::size_t i = 0; i < sides.count(); ++i) {
    Image image = sides.develop(i);
    image.metadata = metadata;
    const std::filesystem::path file = outfile.parent_path() / sides.description(i).name;
    const SavedImage saved = saveImage(file, image, options.write);
    if (saved.problem.empty()) continue;
    std::cerr << "pbrt: error: " << saved.problem << "; the image is in \"" << saved.file.string()
              << "\" instead\n";
    status = kExitBadInput;
  }
  if (options.quiet) return;
  std::cerr << "wrote an image for each of " << sides.count() << " strategies, "
            << (outfile.parent_path() / sides.description(0).name).string() << " and so on\n";
}

/// The image of a range, with what other ranges of the render are added to.
Image asRange(Image image, const SampleRange& range, const Construction& scene) {
  image.metadata["sampleRange"] = std::to_string(range.first) + ':' + std::to_string(range.end);
  image.metadata["samplesPlanned"] = std::to_string(scene.sampler->samplesPerPixel());
  const Film& film = *scene.film;
  image = withSums(image, film.state().sums, film.development(), film.otherSums());
  if (!film.state().splats.empty()) putSplatPaths(film.state().paths, image);
  return image;
}

void fillIn(RenderStatistics& statistics, const RenderedImage& rendered) {
  const RenderResult& result = rendered.result;
  statistics.render = {result.seconds, result.cpuSeconds};
  statistics.measure = rendered.measuring;
  statistics.samplesTaken = static_cast<std::int64_t>(result.samplesTaken);
  statistics.samplesPlanned = static_cast<std::int64_t>(result.samplesTotal);
  statistics.interrupted = result.interrupted;
  statistics.stoppedBy = rendered.stoppedBy;
  statistics.counters = result.counters;
  statistics.learning = result.learning;
  statistics.ranks = rendered.ranks;
}

/// What people should know of the image.
void tell(const RenderResult& result, const RenderStatistics& statistics, const Run& run,
          const Scene& scene) {
  const bool quiet = run.options.quiet;
  if (!quiet) std::cerr << describeStop(result);
  const std::string faults = describeFaults(result, run.options, &scene);
  std::cerr << faults;
  run.watching.warn(faults);
  if (quiet) return;
  std::cerr << describeRisingBounds(result.learning) << describeComplaints(scene)
            << formatStatistics(statistics);
}

int strictStatus(const RenderResult& result) {
  const bool isFaulty = result.counters.droppedTotal() > 0 || result.counters.boundViolations > 0;
  if (isFaulty) return kExitStrict;
  return result.interrupted ? kExitEarly : 0;
}

}  // namespace

int worseStatus(int a, int b) {
  if (a == 0 || b == 0) return std::max(a, b);
  return std::min(a, b);
}

std::string sceneNames(const Options& options) {
  std::string names;
  for (const auto& scene : options.scenes) {
    if (!names.empty()) names += ' ';
    names += scene.string();
  }
  return names;
}

std::optional<RenderStatistics> renderWorld(SceneDescription& description, const WorldId& id, const Run& run,
                                            const PhaseTime& parseTime, int& status) {
  const Options& options = run.options;
  RenderStatistics statistics;
  statistics.scene = sceneNames(options);
  statistics.seed = options.seed;
  statistics.threads = threadCount();
  statistics.parse = parseTime;

  const BuiltParts builtBefore = builtParts();
  const Stopwatch constructing;
  std::optional<BuiltWorld> world;
  try {
    run.together.step([&] {
      world.emplace(build(description, run));
      if (options.derivative) differentiate(*world, run);
      statistics.construct = constructing.elapsed();
      begin(*world, id, run);
    });
  } catch (const ShownFailure&) {
    status = kExitBadInput;
    return std::nullopt;
  }
  const Construction& scene = world->scene;
  statistics.outfile = scene.outfile.string();
  statistics.samplesPerPixel =
      options.samples ? options.samples->end - options.samples->first : scene.sampler->samplesPerPixel();

  if (run.together.isFirst()) StopSignal::say(kImageSoFar);
  run.watching.begin(statistics.outfile, statistics.samplesPerPixel);
  const RenderedImage rendered =
      renderImage(scene, options, run.ending, run.watching, run.checkpoints, run.together);
  fillIn(statistics, rendered);
  const RenderResult& result = rendered.result;
  if (world->derivative) {
    statistics.derivative = {*options.derivative, world->derivative->samplesPerPass(), result.passes,
                             world->derivative->built()};
  }
  if (!run.together.isFirst()) return statistics;                        // the first does the rest
  if (result.samplesTaken == 0 && result.interrupted) leaveIfStopped();  // black would be a wrong image
  const Stopwatch writing;
  run.watching.enter("writing");
  if (!run.checkpoints.finish(scene, result)) status = kExitBadInput;
  statistics.parts = run.checkpoints.parts();
  Image image = withHeader(scene.film->develop(), statistics, options, world->identity);
  // Who merges images wants to know what their channels are.
  if (!scene.film->layers().isEmpty()) image.metadata["layers"] = scene.film->layers().text();
  if (options.derivative && !options.quiet) std::cerr << describeStandstill(image, *options.derivative);
  const std::string written =
      options.samples ? writeRendered(scene.outfile, asRange(image, *options.samples, scene), options, status)
                      : writeRendered(scene.outfile, image, options, status);
  if (rendered.sides) writeSideImages(scene.outfile, *rendered.sides, image.metadata, options, status);
  if (!options.samples) run.bounds.save(id.name, *scene.scene);
  statistics.write = writing.elapsed();
  statistics.built = builtParts() - builtBefore;
  statistics.peakMemory = peakMemoryBytes();
  tell(result, statistics, run, *scene.scene);
  run.watching.finish(image, result, written);
  if (options.strict) status = worseStatus(status, strictStatus(result));
  return statistics;
}

}  // namespace pbrtmedia
