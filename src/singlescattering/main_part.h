// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A point where the extinction along a ray has been looked up.
struct Explorer {
  double t;           ///< on the ray, or on the neighbour that it was found on
  Rgb extinction;     ///< 1/length
  double difference;  ///< how far the extinction nearby was seen to lie off the line through explorers
};

/// An extinction along a stretch of a ray that is integrated exactly: linear between explorers, constant
/// before the first and behind the last. Szirmay-Kalos, Georgiev, Magdics, Molnár & Légrády 2017, section 4.
class MainPart {
 public:
  static constexpr std::size_t kMost = 64;  ///< explorers; those beyond are not looked at
  using Channels = std::array<double, 3>;

  /// `explorers`: at least one, in order of t, all within [tMin, tMax], which is finite.
  MainPart(std::span<const Explorer> explorers, double tMin, double tMax);

  struct Value {
    Channels extinction;  ///< 1/length
    Channels depth;       ///< its integral from tMin
  };
  /// tMin <= t <= tMax.
  Value at(double t) const;
  double tMin() const { return nodes_[0].t; }
  double tMax() const { return nodes_[count_ - 1].t; }
  double length() const { return tMax() - tMin(); }
  const Channels& depth() const { return nodes_[count_ - 1].value.depth; }
  /// Where the integral of a channel reaches `depth`, in [0, depth()[channel]].
  double invert(std::size_t channel, double depth) const;
  /// The largest of the explorers' differences.
  double largestDifference() const { return largestDifference_; }

 private:
  struct Node {
    double t = 0;
    Value value{};
  };
  void add(double t, Rgb extinction);

  std::array<Node, kMost + 2> nodes_;
  std::size_t count_ = 0;
  double largestDifference_ = 0;
};

}  // namespace pbrtmedia
