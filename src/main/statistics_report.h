// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/built_parts.h"
#include "base/statistics.h"
#include "base/stopwatch.h"
#include "main/checkpoint_file.h"
#include "main/options.h"
#include "main/render_image.h"
#include "render/render_result.h"

namespace pbrtmedia {

/// How a derivative was made.
struct DerivativeRecord {
  DerivativeOptions options;
  int samplesPerPass = 0;
  std::uint64_t passes = 0;
  std::size_t scenesBuilt = 0;  ///< besides that at the value of the variable
};

/// What one render cost and met with.
struct RenderStatistics {
  std::string scene;  ///< file names as given
  std::string outfile;
  std::uint64_t seed = 0;
  std::int64_t samplesPerPixel = 0;  ///< asked for
  std::int64_t samplesTaken = 0;     ///< camera samples of the whole film
  std::int64_t samplesPlanned = 0;
  unsigned threads = 0;
  bool interrupted = false;
  std::string stoppedBy;                               ///< RenderedImage::stoppedBy
  PhaseTime parse, construct, render, measure, write;  ///< `render`: of all parts
  std::vector<RankShare> ranks;                        ///< where several rendered it
  std::optional<DerivativeRecord> derivative;          ///< where the image is one
  std::vector<RenderPart> parts;                       ///< one for each process that rendered some of it
  RenderCounters counters;
  BuiltParts built;                      ///< for the scene and while it was rendered
  std::vector<LearningRecord> learning;  ///< of media with progressive bounds
  std::size_t peakMemory = 0;            ///< bytes
};

/// The numbers as text for people: a few lines, most telling first.
std::string formatStatistics(const RenderStatistics& statistics);
/// "samples 0 to 12 in 3.2s (cpu 6.1s, 2 threads)", a line each.
std::string formatParts(const std::vector<RenderPart>& parts);
/// The numbers as a JSON object; keys in docs/statistics.md.
std::string statisticsText(const RenderStatistics& statistics);
/// Writes {"version": …, "renders": [ … ]} of such objects atomically.
void writeStatistics(const std::filesystem::path& path, const std::vector<std::string>& renders);

}  // namespace pbrtmedia
