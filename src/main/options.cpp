// SPDX-License-Identifier: BSD-2-Clause
#include "main/options.h"

#include <glog/logging.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "main/derivative_options.h"
#include "main/option_values.h"
#include "tools/command_line.h"

namespace pbrtmedia {
namespace {

/// What `--serve` without a port is read as.
constexpr const char* kAnywhere = "auto";

Endpoint parseServedOrAnywhere(std::string_view text) {
  return text == kAnywhere ? Endpoint{"127.0.0.1", kPagePort} : parseServed(text);
}

/// A check of an option's text by the function that reads it.
std::function<std::string(std::string&)> problemOf(Endpoint (*parse)(std::string_view)) {
  return [parse](std::string& text) -> std::string {
    try {
      parse(text);
      return {};
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
  };
}

/// Every option of the program: what it is called, what it may be and what --help says of it. Short forms
/// that CLI11 cannot write straight into Options wait here until all words are read.
class OptionList {
 public:
  OptionList() {
    app_.set_help_flag("--help", "print this text");
    app_.get_formatter()->column_width(34);
    app_.add_option("scene", scenes_, "scene files, read in order with one continuous state")
        ->type_name("FILE");
    addImage();
    addVariables();
    addDerivativeOptions(app_, derivative_);
    addSampling();
    addMedia();
    addFiles();
    addCheckpoints();
    addChecks();
    addReports();
    addWatching();
    addOther();
  }

  /// Words without the program's name.
  OptionsOutcome read(const std::vector<std::string>& words);

 private:
  void addImage();
  void addVariables();
  void addSampling();
  void addMedia();
  void addFiles();
  void addCheckpoints();
  void addChecks();
  void addReports();
  void addWatching();
  void addOther();
  void readDerivative();
  std::string normalised(const std::string& word) const;
  /// The words as CLI11 shall read them.
  std::vector<std::string> prepared(const std::vector<std::string>& words) const;
  void setUpLog() const;

  static constexpr const char *kRendering = "Rendering", *kChecks = "Checks", *kReports = "Reports",
                              *kWatching = "Watching", *kOther = "Other";

  CLI::App app_{
      "Renders PBRT-v3 scene files.\n"
      "Without a file, or with '-', the scene is read from standard input.",
      "pbrt"};
  Options options_;
  std::vector<std::string> scenes_;
  std::vector<std::string> defines_;
  DerivativeOptions derivative_;
  std::vector<float> crop_;
  std::vector<std::string> layers_;
  std::string outfile_, frames_, samples_, stats_, boundsCache_, checkpoint_, resume_, convergence_,
      reference_, displayServer_, serve_;
  std::string progress_ = "auto", logDirectory_;
  int minLogLevel_ = 0, verbosity_ = 0;
  bool logToStderr_ = false;
};

void OptionList::addImage() {
  app_.add_option("--nthreads", options_.threads, "worker threads; 0 (default): one per processor")
      ->check(wholeNumber(0u, 4096u))
      ->type_name("N")
      ->group(kRendering);
  app_.add_option("-o,--outfile", outfile_, "image file; overrides the scene's (.exr .png .pfm .tga)")
      ->check(fileName())
      ->group(kRendering);
  app_.add_option("--layers", layers_,
                  "what an EXR image is to hold besides colour: names with commas between them, or all; "
                  "overrides the scene's (docs/layers.md)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("LIST")
      ->group(kRendering);
  app_.add_flag("--png", options_.png, "write the image as a PNG of the same name too")->group(kRendering);
  app_.add_option("--cropwindow", crop_, "render only this part: fractions of the image, y down")
      ->expected(4)
      ->check(number(NumberRange::between(0, 1)))
      ->allow_extra_args(false)  // what follows is the scene
      ->type_name("X0 X1 Y0 Y1")
      ->group(kRendering);
}

void OptionList::addVariables() {
  app_.add_option("--define", defines_, "value of $NAME in the scene: a number, a word, or several in [ ]")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all()
      ->check(definition())
      ->type_name("NAME=VALUE")
      ->group(kRendering);
  app_.add_option("--frames", frames_,
                  "render these frames, A:B or A:B:STEP; $frame is the number; so are ####, %04d and $F4 in "
                  "strings and names of files")
      ->check(frameRange())
      ->type_name("A:B")
      ->group(kRendering);
}

void OptionList::addSampling() {
  app_.add_option("--spp", options_.samplesPerPixel, "samples per pixel instead of the scene's")
      ->check(wholeNumber(std::int64_t{1}, std::int64_t{1} << 40))
      ->type_name("N")
      ->group(kRendering);
  app_.add_option("--samples", samples_,
                  "take only the samples FIRST to LAST - 1 of each pixel; imgtool merge puts ranges together")
      ->check(sampleRange())
      ->type_name("FIRST:LAST")
      ->group(kRendering);
  app_.add_option("--seed", options_.seed, "seed of all random numbers (default 0)")
      ->check(wholeNumber(std::uint64_t{0}, ~std::uint64_t{0}))
      ->type_name("N")
      ->group(kRendering);
  app_.add_option(
          "--time", options_.timeLimit,
          "stop this many seconds after the start, with a valid image of what there is; exit status 1 and no "
          "image when that is nothing yet")
      ->check(number(NumberRange::above(0)))
      ->type_name("SECONDS")
      ->group(kRendering);
  app_.add_option("--error", options_.mostError,
                  "stop when the estimated relative error of the image is at most this (0.02: 2 %)")
      ->check(number(NumberRange::above(0)))
      ->type_name("E")
      ->group(kRendering);
  app_.add_option("--lookups", options_.mostLookups,
                  "stop after the pass in which so many densities of media have been looked up")
      ->check(number(NumberRange::atLeast(1)))
      ->type_name("N")
      ->group(kRendering);
  app_.add_flag("--quick", options_.quick, "a quarter of the resolution each way, one sample per pixel")
      ->group(kRendering);
  app_.add_option("--tile-size", options_.tileSize,
                  "edge of the square of pixels one thread takes (default 16)")
      ->check(wholeNumber(1, 4096))
      ->type_name("PIXELS")
      ->group(kRendering);
}

void OptionList::addMedia() {
  app_.add_option("--mediumparams", options_.mediumParams,
                  "parameters for every medium with a density field, as they stand in a scene: '\"string "
                  "transmittance\" \"regular\"'; they replace those of the scene")
      ->type_name("LIST")
      ->group(kRendering);
  app_.add_option("--bounds-cache", boundsCache_,
                  "start progressive bounds of media from this file if it exists, and write it in the end")
      ->check(fileName())
      ->type_name("FILE")
      ->group(kRendering);
}

void OptionList::addFiles() {
  const std::map<std::string, PixelType> pixelTypes = {{"half", PixelType::Half},
                                                       {"float", PixelType::Float}};
  app_.add_option("--pixeltype", options_.write.pixelType, "half (default) or float numbers in EXR files")
      ->transform(oneOf(pixelTypes))
      ->type_name("TYPE")
      ->group(kRendering);
  const std::map<std::string, ExrCompression> compressions = {
      {"none", ExrCompression::None}, {"zip", ExrCompression::Zip}, {"piz", ExrCompression::Piz}};
  app_.add_option("--compression", options_.write.compression, "of EXR files: zip (default), piz or none")
      ->transform(oneOf(compressions))
      ->type_name("NAME")
      ->group(kRendering);
}

void OptionList::addCheckpoints() {
  CLI::Option* const checkpoint =
      app_.add_option("--checkpoint", checkpoint_,
                      "now and then, and when the render is stopped, write all that --resume needs to go on")
          ->check(fileName())
          ->type_name("FILE")
          ->group(kRendering);
  app_.add_option("--checkpoint-interval", options_.checkpointInterval,
                  "seconds between checkpoints (default 10); more where writing one takes longer than 2 % of "
                  "that")
      ->needs(checkpoint)
      ->check(number(NumberRange::above(0)))
      ->type_name("SECONDS")
      ->group(kRendering);
  app_.add_option(
          "--resume", resume_,
          "go on from a checkpoint of the same scene and options, to the same image; with --checkpoint "
          "of the same name it need not exist yet")
      ->check(fileName())
      ->type_name("FILE")
      ->group(kRendering);
}

void OptionList::addChecks() {
  app_.add_flag("--lenient", options_.lenient,
                "the default, kept as a word: what PBRT-v3 renders is rendered, with warnings")
      ->group(kChecks);
  app_.add_flag(
          "--strict", options_.strict,
          "what PBRT-v3 renders in spite of a mistake is an error; "
          "exit with 2 when samples were dropped or a density bound was violated, with 3 when the image "
          "has fewer samples than planned; of several worlds or frames the worst counts: 1, 2, 3, 0")
      ->group(kChecks);
}

void OptionList::addReports() {
  app_.add_flag("--quiet", options_.quiet, "no progress, notes or warnings; errors stay")->group(kReports);
  app_.add_flag("--verbose", options_.verbose, "say what was built, what was left out and what that saved")
      ->group(kReports);
  app_.add_option("--progress", progress_,
                  "auto (default): a live line on a terminal; plain: a line now and then; none")
      ->transform(oneOf({"auto", "plain", "none"}))
      ->type_name("MODE")
      ->group(kReports);
  CLI::Option* const convergence =
      app_.add_option("--convergence", convergence_,
                      "write how the error falls with time (docs/convergence.md); without --reference it is "
                      "estimated")
          ->check(fileName())
          ->type_name("FILE.csv")
          ->group(kReports);
  app_.add_option("--reference", reference_, "the image that --convergence measures against")
      ->check(fileName())
      ->needs(convergence)
      ->type_name("FILE")
      ->group(kReports);
  app_.add_option("--stats", stats_, "write times, counters and memory as JSON")
      ->check(fileName())
      ->type_name("FILE.json")
      ->group(kReports);
}

void OptionList::addWatching() {
  app_.add_option(
          "--display-server", displayServer_,
          "send the image so far to an image viewer that listens there, as tev does (without a port: " +
              std::to_string(kTevPort) + ")")
      ->check(CLI::Validator(problemOf(parseViewer), ""))
      ->type_name("HOST:PORT")
      ->group(kWatching);
  app_.add_option("--serve", serve_,
                  "serve a page that shows the render to a browser on this machine, at this port or one that "
                  "is free; "
                  "ADDRESS:PORT serves others too")
      ->check(CLI::Validator(problemOf(parseServedOrAnywhere), ""))
      ->type_name("[PORT]")
      ->group(kWatching);
}

void OptionList::addOther() {
  app_.add_flag("--cat", options_.cat, "print the scene in a normal form; render nothing")->group(kOther);
  app_.add_flag("--toply", options_.toPly, "as --cat, with large meshes written to PLY files")->group(kOther);
  app_.add_option("--logdir", logDirectory_, "folder for log files")->group(kOther);
  app_.add_flag("--logtostderr", logToStderr_, "log to standard error instead of files")->group(kOther);
  app_.add_option("--minloglevel", minLogLevel_, "0 info, 1 warning, 2 error, 3 fatal")
      ->check(wholeNumber(0, 3))
      ->group(kOther);
  app_.add_option("--v", verbosity_, "verbosity of the log")->check(wholeNumber(0, 1000))->group(kOther);
}

/// "-quick" and "-nthreads=2", which PBRT-v3 accepts, become "--quick" and "--nthreads=2"; numbers and file
/// names stay.
std::string OptionList::normalised(const std::string& word) const {
  if (word.size() < 2 || word[0] != '-' || word[1] == '-') return word;
  const std::string name = word.substr(1, word.find('=') - 1);
  if (name == "h") return "--help";
  const bool isKnown = name == "version" || app_.get_option_no_throw("--" + name) != nullptr;
  return isKnown ? "-" + word : word;
}

void OptionList::setUpLog() const {
  FLAGS_minloglevel = minLogLevel_;
  FLAGS_v = verbosity_;
  FLAGS_logtostderr = logToStderr_ || logDirectory_.empty();
  if (!logDirectory_.empty()) FLAGS_log_dir = logDirectory_;
  if (!logToStderr_ && logDirectory_.empty() && minLogLevel_ == 0) FLAGS_minloglevel = google::GLOG_ERROR;
}

std::vector<std::string> OptionList::prepared(const std::vector<std::string>& words) const {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < words.size(); ++i) {
    known.push_back(normalised(words[i]));
    // The port may be left out, and CLI11 would take the scene for it.
    const bool hasPort = i + 1 < words.size() && looksServed(words[i + 1]);
    if (known.back() == "--serve" && !hasPort) known.back() += std::string("=") + kAnywhere;
  }
  return known;
}

void OptionList::readDerivative() {
  if (derivative_.variable.empty()) return;
  derivative_.difference.seed = options_.seed;
  options_.derivative = derivative_;
  // Its numbers have any size, and are there to be reckoned with.
  if (app_.count("--pixeltype") == 0) options_.write.pixelType = PixelType::Float;
}

OptionsOutcome OptionList::read(const std::vector<std::string>& words) {
  if (const std::optional<int> status = parseCommandLine(app_, prepared(words)))
    return {std::nullopt, *status};

  for (const std::string& scene : scenes_) options_.scenes.emplace_back(scene);
  if (options_.scenes.empty()) options_.scenes.emplace_back("-");
  for (const std::string& define : defines_) {
    const std::size_t equals = define.find('=');
    options_.variables.set(define.substr(0, equals), std::string_view(define).substr(equals + 1));
  }
  readDerivative();
  if (!frames_.empty()) options_.frames = parseFrameRange(frames_);
  if (!outfile_.empty()) options_.outfile = outfile_;
  if (!samples_.empty()) options_.samples = parseSampleRange(samples_);
  if (!stats_.empty()) options_.statsFile = stats_;
  if (!boundsCache_.empty()) options_.boundsCache = boundsCache_;
  if (!convergence_.empty()) options_.convergence = convergence_;
  if (!reference_.empty()) options_.reference = reference_;
  if (!displayServer_.empty()) options_.displayServer = parseViewer(displayServer_);
  if (!serve_.empty()) options_.serve = parseServedOrAnywhere(serve_);
  options_.isServePortFixed = serve_ != kAnywhere;
  if (!checkpoint_.empty()) options_.checkpoint = checkpoint_;
  if (!resume_.empty()) options_.resume = resume_;
  if (!layers_.empty()) options_.layers = layers_;
  if (!crop_.empty()) {
    std::array<float, 4> window{};
    std::copy(crop_.begin(), crop_.end(), window.begin());
    options_.cropWindow = window;
  }
  options_.progress = progress_ == "none"    ? ProgressMode::None
                      : progress_ == "plain" ? ProgressMode::Plain
                                             : ProgressMode::Auto;
  setUpLog();
  return {std::move(options_), 0};
}

}  // namespace

OptionsOutcome readOptions(int argc, const char* const* argv) {
  OptionsOutcome outcome = OptionList().read({argv + 1, argv + argc});
  if (!outcome.options) return outcome;
  std::string& typed = outcome.options->commandLine;
  for (int i = 0; i < argc; ++i) typed += (i > 0 ? " " : "") + shellWord(argv[i]);
  return outcome;
}

}  // namespace pbrtmedia
