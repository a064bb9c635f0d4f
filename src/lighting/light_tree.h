// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "lights/light_extent.h"

namespace pbrtmedia {

/// A binary tree over lights at finite places, each node with bounds, the cone of directions it shines into
/// and its intensity: one light is chosen by walking down, in a number of steps that is the depth. Built by
/// the surface area orientation heuristic of Conty Estevez & Kulla 2018, doi:10.1145/3233305. Immutable,
/// thread-safe. Memory: about 130 bytes a light.
class LightTree {
 public:
  struct Source {
    LightExtent extent;  ///< bounds not empty
    double intensity;    ///< W/sr in directions of full strength, > 0
  };
  /// What an importance of a node may go by.
  struct Node {
    Point3f centre;        ///< of the bounds
    float radius;          ///< of the sphere around them
    Vector3f axis;         ///< of the cone
    float cosSpread;       ///< of its half-angle
    float sinSpread;       ///< of the same
    float cosFade;         ///< of LightExtent::fade
    float intensity;       ///< of all lights below
    std::uint32_t right;   ///< the second child, the first being the next node; 0: a leaf
    std::uint32_t source;  ///< of a leaf
    std::uint32_t parent;
    bool isLeaf() const { return right == 0; }
  };

  LightTree() = default;
  /// Choices are indices into `sources`.
  explicit LightTree(std::span<const Source> sources);

  bool isEmpty() const { return nodes_.empty(); }
  /// The root is number 0.
  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  std::size_t nodeCount() const { return nodes_.size(); }
  std::uint32_t leafOf(std::size_t source) const { return leaves_[source]; }

  struct Choice {
    std::size_t source;
    double probability;
  };
  /// A light below `node`: at each step the child is taken in proportion to importance(child), which is to be
  /// positive for what may have a part in the image. Where it is 0 for both, in proportion to intensity.
  /// `u` in [0, 1).
  template <class Importance>
  Choice choose(std::uint32_t node, double u, const Importance& importance) const {
    double probability = 1;
    while (!nodes_[node].isLeaf()) {
      const double left = shareOfFirst(node, importance);
      if (u < left) {
        u /= left;
        probability *= left;
        ++node;
      } else {
        u = std::min((u - left) / (1 - left), 1 - 0x1p-53);
        probability *= 1 - left;
        node = nodes_[node].right;
      }
    }
    return {nodes_[node].source, probability};
  }
  /// Of that choice; `source` is below `node`.
  template <class Importance>
  double probability(std::uint32_t node, std::size_t source, const Importance& importance) const {
    double probability = 1;
    for (std::uint32_t i = leaves_[source]; i != node; i = nodes_[i].parent) {
      const std::uint32_t parent = nodes_[i].parent;
      const double left = shareOfFirst(parent, importance);
      probability *= i == parent + 1 ? left : 1 - left;
    }
    return probability;
  }

 private:
  class Builder;
  template <class Importance>
  double shareOfFirst(std::uint32_t node, const Importance& importance) const {
    const Node& first = nodes_[node + 1];
    const Node& second = nodes_[nodes_[node].right];
    double a = importance(first), b = importance(second);
    if (!(a + b > 0) || !(a + b < kLargest)) a = first.intensity, b = second.intensity;
    return a / (a + b);
  }
  static constexpr double kLargest = 1e300;

  std::vector<Node> nodes_;  ///< depth first
  std::vector<std::uint32_t> leaves_;
};

}  // namespace pbrtmedia
