// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "fields/learned_bounds.h"
#include "film/film.h"
#include "render/render_result.h"

namespace pbrtmedia {

class Scene;

/// All that a render goes on from after whole passes, so that another process takes the samples that are left
/// with the same random numbers and adds them in the same order.
struct RenderState {
  RenderResult result;  ///< so far; its completedSamplesPerPixel says where to go on
  Film::State film;
  std::vector<LearnedBounds::State> bounds;  ///< of the scene's learners, in their order
};

/// To be called after a whole pass (RenderOptions::afterPass), before one that was left inside is added
/// (RenderOptions::beforePartialPass), or after the last one.
RenderState saveState(const Scene& scene, const Film& film, const RenderResult& result);
/// Puts film and bounds into that state; RenderOptions::start is for the rest. False, changing nothing, when
/// it is of another film or other media.
bool restoreState(const RenderState& state, const Scene& scene, Film& film);

}  // namespace pbrtmedia
