// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/frame_names.h"
#include "display/endpoint.h"
#include "image/image.h"
#include "render/difference_schedule.h"
#include "scene/variables.h"

namespace pbrtmedia {

enum class ProgressMode { Auto, Plain, None };

/// Indices [first, end) of the samples of each pixel.
struct SampleRange {
  std::int64_t first = 0, end = 0;
};

/// What `--derivative` asks for.
struct DerivativeOptions {
  std::string variable{};
  /// The seed is that of the render; the value that of the scene, which `atItsValue` finds.
  DifferenceSchedule::Params difference{};
  std::optional<int> samplesPerPass{};
};

/// The command line of `pbrt`, checked.
struct Options {
  std::vector<std::filesystem::path> scenes;  ///< "-" alone: standard input
  Variables variables{};                      ///< those of --define
  std::optional<FrameRange> frames;           ///< rendered one after the other
  bool framesShareFolder = false;             ///< of one of several frames: their images may be in one folder
  std::optional<DerivativeOptions> derivative;  ///< the image is that of a derivative
  unsigned threads = 0;                         ///< 0: one per processor
  std::optional<std::filesystem::path> outfile;
  std::optional<std::array<float, 4>> cropWindow;  ///< x0 x1 y0 y1, fractions
  std::optional<std::vector<std::string>> layers;  ///< instead of the scene's
  bool png = false;                                ///< write a PNG beside the image too
  bool quick = false;
  bool quiet = false;
  bool cat = false;
  bool toPly = false;
  bool lenient = false;  ///< asks for the default; kept because scripts say it
  bool strict = false;
  bool verbose = false;
  std::optional<std::int64_t> samplesPerPixel;
  std::optional<SampleRange> samples;  ///< only these are taken
  std::uint64_t seed = 0;
  std::optional<std::filesystem::path> statsFile;
  ProgressMode progress = ProgressMode::Auto;
  std::optional<std::filesystem::path> boundsCache;
  std::optional<std::filesystem::path> checkpoint, resume;
  double checkpointInterval = 10;   ///< seconds
  std::string mediumParams;         ///< parameter list for the media with a density field; "": none
  std::optional<double> timeLimit;  ///< seconds since the start
  std::optional<double> mostError;  ///< relative: stop when the image is as good
  std::optional<double> mostLookups;
  std::optional<std::filesystem::path> reference,
      convergence;  ///< what to measure against, and where to write
  int tileSize = 16;
  std::optional<Endpoint> displayServer;  ///< the image viewer that gets the image so far
  std::optional<Endpoint> serve;          ///< where the page that shows the render is served
  bool isServePortFixed = true;           ///< false: another port will do
  WriteOptions write;                     ///< how EXR files are stored
  std::string commandLine;                ///< as typed, for the image header
};

/// What reading the command line led to: options to run with, or an exit status after help or an error was
/// printed.
struct OptionsOutcome {
  std::optional<Options> options;
  int exitStatus = 0;
};

/// Reads PBRT-v3's options (`--name value`, `--name=value`, single dash too) and our own. Prints help to
/// standard output and errors to standard error, nothing else; throws nothing.
OptionsOutcome readOptions(int argc, const char* const* argv);

}  // namespace pbrtmedia
