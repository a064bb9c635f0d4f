// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/bounds.h"
#include "base/statistics.h"
#include "integrators/bdpt/bdpt_setup.h"
#include "integrators/mlt/primary_sampler.h"

namespace pbrtmedia {

class Camera;

/// What a point of primary sample space brings to the image, as a splat (SplatBuffer) of paths that spread
/// over the whole of `StrategyFilm::bounds`.
struct StrategySample {
  Point2f film{};
  Rgb value{};
};

/// Where on the film chains go.
struct StrategyFilm {
  const Camera& camera;
  Bounds2i bounds;      ///< pixels
  double imageArea{0};  ///< of the whole image, pixels
};

/// One path of `depth` scatterings, by one of the strategies of `bdpt` that find such paths, which the
/// sampler chooses with equal probability: multiplexed Metropolis light transport (Hachisuka, Kaplanyan &
/// Dachsbacher 2014, doi:10.1145/2601097.2601138). `setup.maxDepth` is not looked at.
StrategySample sampleStrategy(const BdptSetup& setup, const MediaTopology& media, const StrategyFilm& film,
                              int depth, PrimarySampler& sampler, RenderCounters& counters);

}  // namespace pbrtmedia
