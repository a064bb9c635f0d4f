// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/hash.h"
#include "base/vec.h"

namespace pbrtmedia {

/// Tells in linear time and no memory whether triangles close: whether every edge is passed an even number of
/// times, and as often in one direction as in the other. Edges are known by a hash of the positions of their
/// ends; sums of 128 bits vanish by chance once in 2^128.
class EdgeBalance {
 public:
  void addTriangle(Point3f a, Point3f b, Point3f c) {
    addEdge(a, b);
    addEdge(b, c);
    addEdge(c, a);
  }
  void add(const EdgeBalance& o) {
    for (std::size_t i = 0; i < 2; ++i) parity_[i] ^= o.parity_[i], flow_[i] += o.flow_[i];
  }
  /// Every edge belongs to an even number of triangles.
  bool isClosed() const { return parity_[0] == 0 && parity_[1] == 0; }
  /// And they agree about which side is out.
  bool isOriented() const { return flow_[0] == 0 && flow_[1] == 0; }

 private:
  static std::uint64_t hashOf(Point3f p) {
    const auto bits = [](float x) {
      return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0f)};
    };  // -0 is 0
    return hashCombine(bits(p.x) << 32 | bits(p.y), bits(p.z));
  }
  void addEdge(Point3f a, Point3f b) {
    const std::uint64_t from = hashOf(a), to = hashOf(b);
    if (from == to) return;  // a point
    const std::uint64_t low = from < to ? from : to, high = from < to ? to : from;
    const std::array<std::uint64_t, 2> edge{hashCombine(low, high), hashCombine(high, low)};
    for (std::size_t i = 0; i < 2; ++i) {
      parity_[i] ^= edge[i];
      flow_[i] += from < to ? edge[i] : 0 - edge[i];
    }
  }
  std::array<std::uint64_t, 2> parity_{}, flow_{};
};

}  // namespace pbrtmedia
