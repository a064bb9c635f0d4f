// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "integrators/bdpt/strategy_weights.h"
#include "lighting/light_selector.h"
#include "render/sample_context.h"
#include "world/media_topology.h"
#include "world/media_walk.h"

namespace pbrtmedia {

/// What all paths of an integrator share.
struct BdptSetup {
  const Scene& scene;
  int maxDepth;                        ///< scatterings of a path
  const LightSelector* selector;       ///< of light samples; null: there are no lights
  const LightSelector* startSelector;  ///< of light subpaths; null: there are none
  const MediaTopology* media;          ///< null: media are ignored
  bool mediaEmit;                      ///< some medium may emit
  /// There are curves. They face what rays meet them, so those that light finds are others than the camera's:
  /// light subpaths end at them.
  bool hasStrands;
  StrategyWeights weights;
  int sampledVertices = 4;  ///< of a subpath, that the Sampler serves; the others take the Rng
  /// Subpaths of less weight than this, relative to their start, are thinned out by roulette, which their
  /// weights need not know. Light that a thinned light subpath would have found is found by other strategies
  /// as well; what a camera subpath loses is noise in a pixel of its own.
  struct Roulette {
    float camera = 0.3f, light = 1;
  } roulette{};

  MediaWalk::Context walkContext(SampleContext& context) const {
    return {scene, media, context.counters, context.counters.rays, context.mismatches};
  }
  MediaWalk::Context shadowContext(SampleContext& context) const {
    return {scene, media, context.counters, context.counters.shadowRays, context.mismatches};
  }
};

}  // namespace pbrtmedia
