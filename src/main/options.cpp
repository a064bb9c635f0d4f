// SPDX-License-Identifier: BSD-2-Clause
#include "main/options.h"

#include <glog/logging.h>

#include <algorithm>
#include <map>

#include "tools/command_line.h"

namespace pbrtmedia {
namespace {

// Words that PBRT-v3 accepts with one dash as well.
constexpr std::string_view kLongNames[] = {
    "nthreads",     "outfile",      "png",     "cropwindow",  "quick",       "quiet",
    "cat",          "toply",        "logdir",  "logtostderr", "minloglevel", "v",
    "help",         "spp",          "seed",    "stats",       "progress",    "time",
    "strict",       "lenient",      "verbose", "tile-size",   "pixeltype",   "compression",
    "bounds-cache", "mediumparams", "version"};

/// "-quick" and "-nthreads=2" become "--quick" and "--nthreads=2"; numbers and file names stay.
std::string normalised(const std::string& word) {
  if (word.size() < 2 || word[0] != '-' || word[1] == '-') return word;
  const std::string name = word.substr(1, word.find('=') - 1);
  if (name == "h") return "--help";
  return std::find(std::begin(kLongNames), std::end(kLongNames), name) != std::end(kLongNames) ? "-" + word
                                                                                               : word;
}

std::string shellQuoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

OptionsOutcome readOptions(int argc, const char* const* argv) {
  Options options;
  CLI::App app{
      "Renders PBRT-v3 scene files.\n"
      "Without a file, or with '-', the scene is read from standard input.",
      "pbrt"};
  app.set_help_flag("--help", "print this text");
  app.get_formatter()->column_width(34);

  std::vector<std::string> scenes;
  std::vector<float> crop;
  std::string outfile, stats, boundsCache, progress = "auto", logDirectory;
  int minLogLevel = 0, verbosity = 0;
  bool logToStderr = false;

  app.add_option("scene", scenes, "scene files, read in order with one continuous state")->type_name("FILE");
  const std::string render = "Rendering";
  app.add_option("--nthreads", options.threads, "worker threads; 0 (default): one per processor")
      ->check(wholeNumber(0u, 4096u))
      ->type_name("N")
      ->group(render);
  app.add_option("--outfile", outfile, "image file; overrides the scene's (.exr .png .pfm .tga)")
      ->group(render);
  app.add_flag("--png", options.png, "write the image as a PNG of the same name too")->group(render);
  app.add_option("--cropwindow", crop, "render only this part: fractions of the image, y down")
      ->expected(4)
      ->check(number(NumberRange::between(0, 1)))
      ->allow_extra_args(false)  // what follows is the scene
      ->type_name("X0 X1 Y0 Y1")
      ->group(render);
  app.add_option("--spp", options.samplesPerPixel, "samples per pixel instead of the scene's")
      ->check(wholeNumber(std::int64_t{1}, std::int64_t{1} << 40))
      ->type_name("N")
      ->group(render);
  app.add_option("--seed", options.seed, "seed of all random numbers (default 0)")
      ->check(wholeNumber(std::uint64_t{0}, ~std::uint64_t{0}))
      ->type_name("N")
      ->group(render);
  app.add_option(
         "--time", options.timeLimit,
         "stop this many seconds after the start, with a valid image of what there is; exit status 1 and no "
         "image when that is nothing yet")
      ->check(number(NumberRange::above(0)))
      ->type_name("SECONDS")
      ->group(render);
  app.add_flag("--quick", options.quick, "a quarter of the resolution each way, one sample per pixel")
      ->group(render);
  app.add_option("--tile-size", options.tileSize,
                 "edge of the square of pixels one thread takes (default 16)")
      ->check(wholeNumber(1, 4096))
      ->type_name("PIXELS")
      ->group(render);

  app.add_option("--mediumparams", options.mediumParams,
                 "parameters for every medium with a density field, as they stand in a scene: '\"string "
                 "transmittance\" \"regular\"'; they replace those of the scene")
      ->type_name("LIST")
      ->group(render);
  app.add_option("--bounds-cache", boundsCache,
                 "start progressive bounds of media from this file if it exists, and write it in the end")
      ->type_name("FILE")
      ->group(render);

  const std::map<std::string, PixelType> pixelTypes = {{"half", PixelType::Half},
                                                       {"float", PixelType::Float}};
  app.add_option("--pixeltype", options.write.pixelType, "half (default) or float numbers in EXR files")
      ->transform(oneOf(pixelTypes))
      ->type_name("TYPE")
      ->group(render);
  const std::map<std::string, ExrCompression> compressions = {
      {"none", ExrCompression::None}, {"zip", ExrCompression::Zip}, {"piz", ExrCompression::Piz}};
  app.add_option("--compression", options.write.compression, "of EXR files: zip (default), piz or none")
      ->transform(oneOf(compressions))
      ->type_name("NAME")
      ->group(render);

  const std::string checks = "Checks";
  app.add_flag("--lenient", options.lenient,
               "the default, kept as a word: what PBRT-v3 renders is rendered, with warnings")
      ->group(checks);
  app.add_flag("--strict", options.strict,
               "what PBRT-v3 renders in spite of a mistake is an error; "
               "exit with 2 when samples were dropped or a density bound was violated")
      ->group(checks);

  const std::string reports = "Reports";
  app.add_flag("--quiet", options.quiet, "no progress, notes or warnings; errors stay")->group(reports);
  app.add_flag("--verbose", options.verbose, "say what was built, what was left out and what that saved")
      ->group(reports);
  app.add_option("--progress", progress,
                 "auto (default): a live line on a terminal; plain: a line now and then; none")
      ->transform(oneOf({"auto", "plain", "none"}))
      ->type_name("MODE")
      ->group(reports);
  app.add_option("--stats", stats, "write times, counters and memory as JSON")
      ->type_name("FILE.json")
      ->group(reports);

  const std::string other = "Other";
  app.add_flag("--cat", options.cat, "print the scene in a normal form; render nothing")->group(other);
  app.add_flag("--toply", options.toPly, "as --cat, with large meshes written to PLY files")->group(other);
  app.add_option("--logdir", logDirectory, "folder for log files")->group(other);
  app.add_flag("--logtostderr", logToStderr, "log to standard error instead of files")->group(other);
  app.add_option("--minloglevel", minLogLevel, "0 info, 1 warning, 2 error, 3 fatal")
      ->check(wholeNumber(0, 3))
      ->group(other);
  app.add_option("--v", verbosity, "verbosity of the log")->check(wholeNumber(0, 1000))->group(other);

  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) words.push_back(normalised(argv[i]));
  for (int i = 0; i < argc; ++i) options.commandLine += (i > 0 ? " " : "") + shellQuoted(argv[i]);
  if (const std::optional<int> status = parseCommandLine(app, words)) return {std::nullopt, *status};

  for (const std::string& scene : scenes) options.scenes.emplace_back(scene);
  if (options.scenes.empty()) options.scenes.emplace_back("-");
  if (!outfile.empty()) options.outfile = outfile;
  if (!stats.empty()) options.statsFile = stats;
  if (!boundsCache.empty()) options.boundsCache = boundsCache;
  if (!crop.empty()) {
    std::array<float, 4> window{};
    std::copy(crop.begin(), crop.end(), window.begin());
    options.cropWindow = window;
  }
  options.progress = progress == "none"    ? ProgressMode::None
                     : progress == "plain" ? ProgressMode::Plain
                                           : ProgressMode::Auto;

  FLAGS_minloglevel = minLogLevel;
  FLAGS_v = verbosity;
  FLAGS_logtostderr = logToStderr || logDirectory.empty();
  if (!logDirectory.empty()) FLAGS_log_dir = logDirectory;
  if (!logToStderr && logDirectory.empty() && minLogLevel == 0) FLAGS_minloglevel = google::GLOG_ERROR;
  return {std::move(options), 0};
}

}  // namespace pbrtmedia
