// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fields/learned_bounds.h"
#include "render/ranks.h"
#include "render/render_result.h"

namespace pbrtmedia {

class Medium;
class Scene;

/// The media of a scene whose bounds are learned (Medium::learnedBounds), while it is rendered: explored
/// before the first sample where nothing is known of them yet, put into force after each pass.
class BoundsLearning {
 public:
  /// Adds a record for each to `result.learning`, unless there are some from an earlier part of the render.
  /// `isFixed`: bounds are not learned any more; then nothing else happens.
  BoundsLearning(const Scene& scene, bool isFixed, Ranks& ranks, RenderResult& result);

  /// Then every pass takes one sample of each pixel and publishes what it learned: so pass k sees the same
  /// bounds however samples are grouped otherwise.
  bool isNeeded() const { return !isFixed_ && !learners_.empty(); }
  /// Explores the bounds that nobody knows anything of (Medium::exploreBounds), within a number of look-ups
  /// that follows the samples to take, and puts what was found into force. `shouldStop` is asked on the way,
  /// on any thread.
  void warmUp(std::uint64_t seed, const std::function<bool()>& shouldStop);
  /// Puts into force what a pass of `samples` has learned on all ranks.
  void publish(std::uint64_t samples);

 private:
  /// Puts into force what the look-ups of all ranks have proposed.
  void publish(LearnedBounds& bounds);
  void explore(std::size_t learner, std::uint64_t seed, const std::function<bool()>& shouldStop);
  /// Look-ups that the exploration of one medium may take.
  std::uint64_t warmUpBudget() const;

  std::vector<Medium*> learners_;
  bool isFixed_;
  Ranks& ranks_;
  RenderResult& result_;
};

}  // namespace pbrtmedia
