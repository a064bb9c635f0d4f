// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace pbrtmedia {

/// Piecewise-constant density over [0, 1), from non-negative weights. All zero: uniform.
/// Sums run in double. An element of weight 0 is never sampled, whatever u (unless all are 0).
class Distribution1D {
 public:
  Distribution1D() = default;
  explicit Distribution1D(std::span<const float> weights);

  struct Sample {
    float x;            ///< in [0, 1)
    float pdf;          ///< density with respect to x
    std::size_t index;  ///< element that holds x
  };
  Sample sample(float u) const;
  struct Choice {
    std::size_t index;
    float probability;  ///< > 0
    float remapped;     ///< u, stretched to [0, 1) within the element: may be used again
  };
  Choice choose(float u) const;
  float pdf(float x) const;
  float probability(std::size_t index) const;
  std::size_t size() const { return weights_.size(); }
  /// Mean of the weights: the integral over [0, 1).
  double integral() const { return integral_; }

 private:
  std::vector<float> weights_;
  std::vector<double> cdf_;  ///< size() + 1 values from 0 to 1
  double integral_ = 0;
};

/// Piecewise-constant density over the unit square, `width` x `height` weights, x fastest.
class Distribution2D {
 public:
  Distribution2D() = default;
  Distribution2D(std::span<const float> weights, std::size_t width, std::size_t height);
  struct Sample {
    Point2f p;
    float pdf;  ///< with respect to area on the unit square
  };
  Sample sample(Point2f u) const;
  float pdf(Point2f p) const;

 private:
  std::vector<Distribution1D> rows_;
  Distribution1D marginal_;
};

}  // namespace pbrtmedia
