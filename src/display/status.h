// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pbrtmedia {

/// How far the learned bounds of one medium are.
struct BoundsStatus {
  std::string medium;
  bool restored = false;  ///< from the bounds of another render
  std::uint64_t passes = 0;
  std::size_t cells = 0, visited = 0, raised = 0;  ///< raised: by the last pass
  float largest = 0;                               ///< bound
  double shortfall = 0;  ///< share of the extinction that the bounds cut away so far
  bool operator==(const BoundsStatus&) const = default;
};

/// Error against time, as it was measured so far: a number of each column in every row; NaN: not known.
struct ErrorHistory {
  std::vector<std::string> columns;  ///< "seconds" among them
  std::vector<std::vector<double>> rows;
  std::string source;  ///< what the errors were measured against
};

/// What a render tells those who watch it, besides the image.
struct RenderStatus {
  std::string run;      ///< another text for each run of the program
  std::string title;    ///< of the scene
  std::string outfile;  ///< where the image will be
  std::string version;
  std::string phase =
      "reading";        ///< "reading", "building", "rendering", "writing", "finished", "stopped", "failed"
  std::string message;  ///< in the end: what was written, or why nothing
  std::uint64_t samplesDone = 0, samplesTotal = 0;  ///< camera samples over all pixels
  std::int64_t samplesPerPixel = 0;                 ///< wanted
  std::uint64_t seed = 0;
  unsigned threads = 0;
  double seconds = 0;                 ///< of rendering
  std::optional<double> secondsLeft;  ///< nothing: not known yet
  ErrorHistory errors;
  std::vector<BoundsStatus> bounds;
  std::vector<std::string> warnings;
};

}  // namespace pbrtmedia
