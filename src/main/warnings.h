// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "main/options.h"
#include "render/render_result.h"
#include "world/scene.h"

namespace pbrtmedia {

/// What went wrong while rendering, as loud text for standard error: dropped samples by cause with the first
/// of them (pixel, sample, seed), violated density bounds, boundaries that contradict each other. Empty when
/// all was well. `scene`: what was rendered, to tell what is wrong with its boundaries; null: they are not
/// told.
std::string describeFaults(const RenderResult& result, const Options& options, const Scene* scene = nullptr);

/// Where learned bounds of media stand at the end of a render, for the image header: "cached" when they came
/// from a cache, else "rising" when some were too low for too many look-ups, else "settled". Empty when none
/// are learned.
std::string boundsState(const std::vector<LearningRecord>& learning);

/// A warning for every medium whose learned bounds were too low for too many look-ups. Empty when none were.
std::string describeRisingBounds(const std::vector<LearningRecord>& learning);

/// What an image lacks that was stopped early: pixels without a sample, paths left on their way. A line each;
/// empty when nothing is missing but further samples.
std::string describeStop(const RenderResult& result);

/// What was wrong with the densities of media, a warning each. Empty when nothing was.
std::string describeComplaints(const Scene& scene);

}  // namespace pbrtmedia
