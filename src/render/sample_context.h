// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/pixel_stream.h"
#include "base/statistics.h"
#include "film/layers.h"
#include "samplers/sampler.h"

namespace pbrtmedia {

class Camera;
class LightTrials;
struct MismatchLog;
class SideSplats;
class SplatBuffer;
class TileMemory;

/// What one camera sample carries through the renderer. Lives on the stack of one thread.
struct SampleContext {
  Sampler& sampler;  ///< dimensions that profit from good distribution
  Rng& rng;          ///< everything of unbounded dimension (tracking, roulette)
  RenderCounters& counters;
  MismatchLog* mismatches = nullptr;  ///< where inconsistent boundaries are noted; null: nowhere
  /// Where integrators of SamplingIntegrator::makesSplats put what light paths bring to other pixels; null
  /// for the others, and where nobody wants them.
  SplatBuffer* splats = nullptr;
  LayerSample layers{};          ///< what the film wants to know besides radiance; nearly always nothing
  PixelSample pixelSample = {};  ///< what `rng` serves, for patterns over the samples of a pixel

  LightTrials* lightTrials = nullptr;  ///< where the light samples of an exploratory path are noted

  const Camera* camera = nullptr;  ///< whose sample it is, for integrators that look for it from the scene
  Point2i pixel = {};
  TileMemory* memory = nullptr;  ///< of SamplingIntegrator::tileMemory; null: samples share nothing

  /// Where integrators with Integrator::sideImages put what the sample brings to them; null: nobody wants it.
  SideSplats* sides = nullptr;

  /// What media draw from.
  PixelStream stream() { return {rng, pixelSample}; }
};

}  // namespace pbrtmedia
