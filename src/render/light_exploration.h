// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "base/statistics.h"
#include "base/vec.h"
#include "lighting/light_trials.h"

namespace pbrtmedia {

class Camera;
class SamplingIntegrator;

/// Paths all over the image that are on no film, and what their light samples found: a function of scene,
/// image size and seed alone, whatever part of the image and of its samples is to be taken. There are as many
/// as an eighth of the pixels, but no more than 16384. `counters`: adds what the paths cost.
///
/// Nothing where `shouldStop`, asked on any thread, or leaveIfAbandoned end it early.
std::optional<LightTrials> exploreLights(const Camera& camera, Point2i resolution,
                                         const SamplingIntegrator& integrator, std::uint64_t seed,
                                         const std::function<bool()>& shouldStop, RenderCounters& counters);

}  // namespace pbrtmedia
