// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// What a light path or a mutation brings to the image, wherever it hits the film.
struct Splat {
  Point2f film;  ///< raster position, pixels
  Rgb value;
  bool isOdd = false;       ///< of a sample of odd index, or of an odd chain
  std::uint64_t order = 0;  ///< in which Film::addSplats sums; each path has one of its own
};

/// The splats of one unit of work (a tile, a chain). One thread writes.
class SplatBuffer {
 public:
  /// What is added from now on is of the sample (or mutation) that stands at `order` among those of all
  /// units; no other unit has it. `isOdd`: its index is odd.
  void begin(std::uint64_t order, bool isOdd = false) {
    order_ = order;
    isOdd_ = isOdd;
  }
  void add(Point2f film, Rgb value) { splats_.push_back({film, value, isOdd_, order_}); }
  std::size_t size() const { return splats_.size(); }
  std::span<const Splat> splats() const { return splats_; }
  /// Takes out those from number `from` on for whose value `isBad` holds; it may change the value.
  template <class IsBad>
  void removeIf(std::size_t from, const IsBad& isBad) {
    std::size_t kept = from;
    for (std::size_t i = from; i < splats_.size(); ++i) {
      if (!isBad(splats_[i].value)) splats_[kept++] = splats_[i];
    }
    splats_.resize(kept);
  }
  /// Takes out those of the sample that is under way.
  void dropLast() {
    while (!splats_.empty() && splats_.back().order == order_) splats_.pop_back();
  }

 private:
  std::uint64_t order_ = 0;
  bool isOdd_ = false;
  std::vector<Splat> splats_;
};

}  // namespace pbrtmedia
