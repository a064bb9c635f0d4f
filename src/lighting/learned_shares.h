// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "lighting/light_trials.h"

namespace pbrtmedia {

/// Factors on the importances of clusters of lights that make the noise of light samples least, as trials
/// have shown: visibility, transmittance and what is left to scattered rays are in them. A tree over space
/// has factors for each of its leaves; space is split only where this makes noise less, and factors other
/// than 1 are used only where they do, in each case as the half of the trials says that had no part in
/// learning them. A pure function of the trials.
///
/// Clusters are chosen with p = (1 - d) f h / sum(f h) + d s: h importances, f factors, s shares of power and
/// d the defensive share. Of a light sample X² p is unbiased for the second moment of what its cluster sends,
/// so that trials tell the noise under any other factors, sum(X² p / p'). Where that is least the clusters'
/// parts of the squares are as their mean probabilities, weighted by the squares; each step multiplies the
/// factors by the square root of the quotient.
class LearnedShares {
 public:
  struct Prior {
    std::vector<double> powerShares;  ///< of the clusters, s
    double defensiveShare;            ///< d, in (0, 1)
  };

  LearnedShares() = default;
  static LearnedShares learn(const LightTrials& trials, const Prior& prior);

  /// One factor for each cluster; empty: all are 1.
  std::span<const double> at(Point3f p) const;
  std::size_t cellCount() const { return cells_; }

  /// All of it, as numbers that carry over to another process; and back, nothing when they are none of these.
  std::vector<double> state() const;
  static std::optional<LearnedShares> ofState(std::span<const double> state, std::size_t clusters);

 private:
  class Learner;
  struct Node {
    double split = 0;          ///< position on the axis
    std::uint32_t axis = 3;    ///< 3: a leaf
    std::uint32_t second = 0;  ///< child above the split, the other being the next node; of a leaf, its cell
  };
  std::vector<Node> nodes_;
  std::vector<double> factors_;
  std::size_t clusters_ = 0, cells_ = 0;
};

}  // namespace pbrtmedia
