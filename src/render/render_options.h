// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "base/bounds.h"

namespace pbrtmedia {

class Ranks;
class SideImages;
struct RenderResult;
struct RenderState;

/// How far a render is. Samples are camera samples over all pixels.
struct RenderProgress {
  std::uint64_t samplesDone = 0, samplesTotal = 0;
  double seconds = 0;
};

/// What stands after a pass, when the film holds everything taken so far.
struct PassEnd {
  RenderProgress progress;
  const RenderResult& result;  ///< so far
  /// To be called before the film is looked at: where others render parts of it, they send them.
  std::function<void()> bringFilm = [] {};
};

/// What a render needs to know beyond scene, camera, sampler and film. The number of threads is the caller's
/// ThreadLimit.
struct RenderOptions {
  std::uint64_t seed = 0;  ///< of the Rng of every sample; the sampler has its own copy
  /// Samples per pixel instead of the sampler's own count.
  std::optional<std::int64_t> samplesPerPixel = std::nullopt;
  std::int64_t firstSample = 0;  ///< sample indices below it are taken as done elsewhere
  /// So are those from this on.
  std::int64_t endSample = std::numeric_limits<std::int64_t>::max();
  /// False: bounds of media stay as they are (they must have started), so that any part of the samples sees
  /// what all the others see.
  bool learnsBounds = true;
  std::optional<Bounds2i> pixelBounds = std::nullopt;  ///< further limits where samples are taken
  int tileSize = 16;                                   ///< pixels; has no effect on the image
  std::optional<int> samplesPerPass = std::nullopt;    ///< has no effect on the image; default: by memory
  /// A pass has at most this share of the samples so far, for who looks on often; has no effect on the image.
  std::optional<double> mostGrowth = std::nullopt;
  /// A pass takes about so many seconds at most, by the rate so far, or else one sample of each pixel; the
  /// same.
  double mostSecondsPerPass = std::numeric_limits<double>::infinity();
  /// Density look-ups: the render stops after the pass that reaches so many, and passes shrink toward it.
  std::optional<std::uint64_t> mostLookups = std::nullopt;
  double timeLimit = std::numeric_limits<double>::infinity();  ///< seconds of rendering
  const std::atomic<bool>* stop = nullptr;                     ///< set to true: stop soon
  /// Called on the calling thread after each whole pass. False: stop. What it takes is no time of rendering.
  std::function<bool(const PassEnd&)> afterPass{};
  /// Called when a pass was left inside (stop, time), before its samples are added: film, bounds in force and
  /// result are those of the last whole pass, as saveState wants them.
  std::function<void(const PassEnd&)> beforePartialPass{};
  /// Called about ten times a second, from any one thread at a time.
  std::function<void(const RenderProgress&)> progress{};
  std::size_t maxRecords = 16;  ///< dropped samples, violations and mismatches that are kept
  /// Go on from here (restoreState has been called): the result is that of one render, bit for bit. Null:
  /// from the beginning.
  const RenderState* start = nullptr;
  /// Those who share the passes, for the same image. The first decides about passes, and it alone calls the
  /// hooks of passes and has the whole film in the end. Null: this process alone.
  Ranks* ranks = nullptr;
  /// Those of Integrator::sideImages, of the film's whole picture, where somebody wants them: this process
  /// alone takes the samples then. They are no part of states and checkpoints.
  SideImages* sides = nullptr;
  /// Asked on the first rank, seconds until `stop` will be set as the time is up; the others are told
  /// (limitSeconds) and set theirs.
  std::function<double()> secondsLeft{};
  std::function<void(double)> limitSeconds{};
};

}  // namespace pbrtmedia
