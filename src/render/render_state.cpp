// SPDX-License-Identifier: BSD-2-Clause
#include "render/render_state.h"

#include "media/medium.h"
#include "world/scene.h"

namespace pbrtmedia {

RenderState saveState(const Scene& scene, const Film& film, const RenderResult& result) {
  RenderState state{result, film.state(), {}};
  for (Medium* learner : scene.learners()) state.bounds.push_back(learner->learnedBounds()->state());
  return state;
}

bool restoreState(const RenderState& state, const Scene& scene, Film& film) {
  const std::vector<Medium*> learners = scene.learners();
  if (state.bounds.size() != learners.size() || state.result.learning.size() != learners.size()) return false;
  for (std::size_t i = 0; i < learners.size(); ++i) {
    if (!learners[i]->learnedBounds()->fits(state.bounds[i])) return false;
  }
  if (!film.restore(state.film)) return false;
  for (std::size_t i = 0; i < learners.size(); ++i) learners[i]->learnedBounds()->restore(state.bounds[i]);
  return true;
}

}  // namespace pbrtmedia
