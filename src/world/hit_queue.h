// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "world/scene.h"

namespace pbrtmedia {

/// Hits in order. The few that a walk along a line looks ahead to are held in place: only where more surfaces
/// coincide is memory allocated.
class HitQueue {
 public:
  HitQueue() {}
  HitQueue(const HitQueue& o) : more_(o.more_), size_(o.size_) { copyInPlace(o); }
  HitQueue& operator=(const HitQueue& o) {
    more_ = o.more_;
    size_ = o.size_;
    copyInPlace(o);
    return *this;
  }

  bool isEmpty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  const SceneHit& operator[](std::size_t i) const { return i < kInPlace ? inPlace_[i] : more_[i - kInPlace]; }
  const SceneHit& front() const { return inPlace_[0]; }

  void add(const SceneHit& hit) {
    if (size_ < kInPlace) {
      std::construct_at(&inPlace_[size_], hit);
    } else {
      more_.push_back(hit);
    }
    ++size_;
  }
  /// Those behind `i` move up.
  void erase(std::size_t i) {
    for (; i + 1 < size_; ++i) (i < kInPlace ? inPlace_[i] : more_[i - kInPlace]) = (*this)[i + 1];
    if (size_ > kInPlace) more_.pop_back();
    --size_;
  }
  void clear() {
    more_.clear();
    size_ = 0;
  }

 private:
  static constexpr std::size_t kInPlace = 3;
  void copyInPlace(const HitQueue& o) {
    for (std::size_t i = 0; i < size_ && i < kInPlace; ++i) std::construct_at(&inPlace_[i], o.inPlace_[i]);
  }

  union {  // nothing is written before it is needed
    std::array<SceneHit, kInPlace> inPlace_;
  };
  std::vector<SceneHit> more_;
  std::size_t size_ = 0;
};

}  // namespace pbrtmedia
