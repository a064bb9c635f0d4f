// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <span>

#include "samplers/base_two.h"
#include "samplers/keys.h"

namespace pbrtmedia {

/// The stream of slots of one sample in which each slot is its own scrambled base-2 sequence, and slots past
/// `dimensions` (1D and 2D counted apart) are random. `count`: samples per pixel, a power of two.
class ZeroTwoSlots {
 public:
  void start(std::uint64_t seed, Point2i pixel, std::int64_t index) {
    key_ = pixelKey(seed, pixel);
    index_ = static_cast<std::uint64_t>(index);
    slot_ = 0;
    used1D_ = used2D_ = 0;
  }
  std::uint64_t index() const { return index_; }
  int used2D() const { return used2D_; }

  float next1D(std::uint32_t count, int dimensions) {
    const std::uint64_t key = nextKey();
    if (used1D_ >= dimensions) return keyToUnit(hashCombine(key, index_));
    ++used1D_;
    return scrambledVanDerCorput(index_, count, key);
  }
  Point2f next2D(std::uint32_t count, int dimensions) {
    const std::uint64_t key = nextKey();
    if (used2D_ >= dimensions) return keyToSquare(hashCombine(key, index_));
    ++used2D_;
    return scrambledZeroTwo(index_, count, key);
  }
  /// Always well distributed: the points of all samples together are one sequence.
  void next2DArray(std::uint32_t count, std::span<Point2f> out) {
    const std::uint64_t key = nextKey(), first = index_ * out.size();
    const int all = indexBits(std::uint64_t{count} * out.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = scrambledZeroTwoRun(first + i, all, key);
  }
  /// Takes a 2D slot that the caller fills himself; its key.
  std::uint64_t take2D() {
    ++used2D_;
    return nextKey();
  }

 private:
  std::uint64_t nextKey() { return subKey(key_, ++slot_); }

  std::uint64_t key_ = 0, index_ = 0, slot_ = 0;
  int used1D_ = 0, used2D_ = 0;
};

}  // namespace pbrtmedia
