// SPDX-License-Identifier: BSD-2-Clause
#include "render/shared_bounds.h"

#include <cstddef>
#include <vector>

#include "base/diagnostics.h"
#include "fields/learned_bounds.h"
#include "media/medium.h"
#include "world/scene.h"

namespace pbrtmedia {

void SharedBounds::lendTo(const Scene& other) const {
  if (&other == &scene_) return;
  const std::vector<Medium*>&own = scene_.learners(), &theirs = other.learners();
  bool fits = own.size() == theirs.size();
  for (std::size_t i = 0; fits && i < own.size(); ++i) {
    const LearnedBounds::State state = own[i]->learnedBounds()->state();
    fits = theirs[i]->learnedBounds()->fits(state);
    if (fits) theirs[i]->learnedBounds()->restore(state);
  }
  if (fits) return;
  throw SceneError({},
                   "the parameter of the derivative changes which media learn their bounds, or how many "
                   "super-voxels these have, so that both sides of a difference cannot share them; give them "
                   "others (\"string bounds\" \"exact\" or \"constant\")");
}

void SharedBounds::takeBackFrom(const Scene& other) const {
  if (&other == &scene_) return;
  for (std::size_t i = 0; i < scene_.learners().size(); ++i) {
    LearnedBounds& own = *scene_.learners()[i]->learnedBounds();
    LearnedBounds& theirs = *other.learners()[i]->learnedBounds();
    own.addProposals(theirs.proposals());
    own.addTally(theirs.takeTally());
  }
}

}  // namespace pbrtmedia
