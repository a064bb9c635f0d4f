// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace pbrtmedia {

// Catmull-Rom splines over increasing nodes: cubics whose slopes at a node are those of its neighbours'
// chord, at an end those of the last piece.

/// A spline at one point, as a sum over the nodes first … first + 3. Nodes outside of the list weigh 0.
struct SplineWeights {
  std::ptrdiff_t first;
  std::array<float, 4> weight;

  /// Σ weight value(node)
  template <class Value>
  float sum(const Value& value) const {
    float total = 0;
    for (std::size_t k = 0; k < weight.size(); ++k) {
      if (weight[k] != 0) total += weight[k] * value(static_cast<std::size_t>(first) + k);
    }
    return total;
  }
};

/// Nothing outside of the nodes (at least two).
std::optional<SplineWeights> splineWeights(std::span<const float> nodes, float x);

/// The integral of a spline from the first node to each; returns the whole.
float integrateSpline(std::span<const float> nodes, std::span<const float> values,
                      std::span<float> cumulative);

/// The x where an increasing spline has a value: the ends of the nodes beyond its values.
float invertSpline(std::span<const float> nodes, std::span<const float> values, float value);

/// The x up to which the integral of a spline (values >= 0, `cumulative` of them) is a share u of the whole.
float sampleSpline(std::span<const float> nodes, std::span<const float> values,
                   std::span<const float> cumulative, float u);

}  // namespace pbrtmedia
