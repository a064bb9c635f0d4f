// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "base/pixel_stream.h"
#include "base/ray.h"
#include "base/statistics.h"
#include "samplers/sampler.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

struct MismatchLog;

/// What one camera sample carries through the renderer. Lives on the stack of one thread.
struct SampleContext {
  Sampler& sampler;  ///< dimensions that profit from good distribution
  Rng& rng;          ///< everything of unbounded dimension (tracking, roulette)
  RenderCounters& counters;
  MismatchLog* mismatches = nullptr;  ///< where inconsistent boundaries are noted; null: nowhere
  PixelSample pixelSample = {};       ///< what `rng` serves, for patterns over the samples of a pixel

  /// What media draw from.
  PixelStream stream() { return {rng, pixelSample}; }
};

/// Light transport: estimates the radiance that arrives along a ray. Immutable after preparation,
/// thread-safe.
class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual std::string_view typeName() const = 0;
  /// `ray`: world space, unit direction, differentials already scaled by 1/sqrt(samples per pixel).
  virtual Rgb radiance(const RayDifferential& ray, SampleContext& context) const = 0;
};

}  // namespace pbrtmedia
