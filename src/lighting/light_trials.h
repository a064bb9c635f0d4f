// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace pbrtmedia {

/// Light samples of exploratory paths that found light: at which point, from which cluster of lights, and
/// what is needed to tell what noise another choice among the clusters would have had.
class LightTrials {
 public:
  struct Trial {
    Point3f p;
    std::uint32_t cluster;
    double moment;  ///< squared contribution to the image times the probability of the cluster
    bool isOdd;     ///< of a path of odd number: one half judges what the other has taught
  };

  /// `importances`: of each cluster, 0 for those that were left out, summing to 1.
  void add(const Trial& trial, std::span<const double> importances) {
    trials_.push_back(trial);
    importances_.insert(importances_.end(), importances.begin(), importances.end());
  }
  void append(const LightTrials& more) {
    trials_.insert(trials_.end(), more.trials_.begin(), more.trials_.end());
    importances_.insert(importances_.end(), more.importances_.begin(), more.importances_.end());
  }
  /// Of the paths that are to come.
  void startPath(std::uint64_t number) { isOdd_ = number % 2 != 0; }
  bool isOdd() const { return isOdd_; }

  std::size_t size() const { return trials_.size(); }
  const Trial& operator[](std::size_t i) const { return trials_[i]; }
  std::span<const float> importances(std::size_t i) const {
    const std::size_t clusters = importances_.size() / trials_.size();
    return std::span(importances_).subspan(i * clusters, clusters);
  }

 private:
  std::vector<Trial> trials_;
  std::vector<float> importances_;
  bool isOdd_ = false;
};

}  // namespace pbrtmedia
