// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/sequence.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "base/frame_names.h"

namespace pbrtmedia {
namespace {

namespace fs = std::filesystem;

std::vector<int> wantedFrames(const SequenceOptions& s, const Notice& notice) {
  if (s.frames.empty()) {
    std::vector<int> frames = framesThatExist(s.input);
    if (frames.empty()) throw std::runtime_error("no frame of " + s.input + " is there");
    std::ostringstream gaps;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      const int missing = frames[i] - frames[i - 1] - 1;
      if (missing == 0) continue;
      gaps << (gaps.tellp() == 0 ? "; not there: " : ", ") << frames[i - 1] + 1;
      if (missing > 1) gaps << '-' << frames[i] - 1;
    }
    notice("frames " + std::to_string(frames.front()) + " to " + std::to_string(frames.back()) + ", " +
           std::to_string(frames.size()) + " files" + gaps.str());
    return frames;
  }
  const auto range = parseFrameRange(s.frames);
  if (!range) {
    throw std::runtime_error("--frames: expected FIRST-LAST or FIRST-LAST:STEP, found \"" + s.frames + '"');
  }
  std::vector<int> frames;
  int missing = 0;
  for (long frame = range->first; frame <= range->last; frame += range->step) {
    const fs::path input = frameName(s.input, static_cast<int>(frame));
    if (fs::exists(input)) {
      frames.push_back(static_cast<int>(frame));
    } else {
      ++missing;
      notice((s.skipMissing ? "left out, not there: " : "not there: ") + input.string());
    }
  }
  if (missing > 0 && !s.skipMissing) {
    throw std::runtime_error(std::to_string(missing) + " frames of " + s.input +
                             " are missing; nothing was converted (--skip-missing leaves them out; without "
                             "--frames all that are there are converted)");
  }
  if (frames.empty()) throw std::runtime_error("no frame of " + s.input + " is there");
  return frames;
}

/// The frame of the largest file: there the volume is fully grown.
int fullestOf(const SequenceOptions& s, const std::vector<int>& frames) {
  return *std::max_element(frames.begin(), frames.end(), [&](int a, int b) {
    return fs::file_size(frameName(s.input, a)) < fs::file_size(frameName(s.input, b));
  });
}

void checkPlace(const std::string& name, const char* option) {
  if (hasFramePlace(name)) return;
  throw std::runtime_error(std::string(option) +
                           " needs a place for the frame in its name, such as %04d, $F4 or "
                           "####, or all frames would be written to one file; found \"" +
                           name + '"');
}

}  // namespace

void convertSequence(const SequenceOptions& s, const ConversionOptions& options, const Notice& notice,
                     const Progress& progress) {
  const auto range = parseFrameRange(s.frames);
  const auto checkPlaces = [&] {
    checkPlace(s.output, "--outfile");
    if (!s.scene.empty()) checkPlace(s.scene, "--scene");
  };
  if (range && range->first != range->last) checkPlaces();
  const std::vector<int> frames = wantedFrames(s, notice);
  if (frames.size() > 1) checkPlaces();
  ConversionOptions common = options;
  common.scene = s.scene;
  std::set<std::string> told;
  const auto once = [&](const std::string& frame, const std::string& line) {
    if (told.insert(line).second) notice(frame + ": " + line);
  };
  if (frames.size() > 1) {
    const int fullest = fullestOf(s, frames);
    const std::string name = "frame " + std::to_string(fullest);
    common = settled(
        frameName(s.input, fullest), common, [&](const std::string& line) { once(name, line); },
        [&](const std::string& what, double share) {
          if (progress) progress(name + ", the largest: " + what, share);
        });
    Bounds3d box;
    for (const int frame : s.scene.empty() ? std::vector<int>() : frames) {
      if (progress) progress("framing, frame " + std::to_string(frame), -1);
      box.expand(boxOfDensities(frameName(s.input, frame), options));
    }
    if (!box.isEmpty()) common.sceneBox = box;
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string name = "frame " + std::to_string(frames[i]),
                      place = std::to_string(i + 1) + " of " + std::to_string(frames.size());
    if (!s.scene.empty()) common.scene = frameName(s.scene, frames[i]);
    convertVdb(
        frameName(s.input, frames[i]), frameName(s.output, frames[i]), common,
        [&](const std::string& line) { once(name, line); },
        [&](const std::string& what, double share) {
          std::string line = name;
          line.append(", ").append(place).append(": ").append(what);
          if (progress) progress(line, share);
        });
  }
}

}  // namespace pbrtmedia
