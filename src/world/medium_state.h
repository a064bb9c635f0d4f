// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "world/primitive.h"
#include "world/scene.h"

namespace pbrtmedia {

/// A medium as seen through a placement (null: where it was defined). A null medium is vacuum.
struct PlacedMedium {
  const Medium* medium = nullptr;
  const Placement* placement = nullptr;
  bool operator==(const PlacedMedium&) const = default;
};

/// The media a point of a path is in. Two layers (OverlapRule): the boundary medium, of which there is one,
/// named by the boundary crossed last; and the media of the rules Add and Priority whose boundaries were
/// entered and not yet left, any number of them, each as often as it was entered. A value type: copies of
/// states with few media allocate nothing.
class MediumState {
 public:
  MediumState() = default;  ///< vacuum
  explicit MediumState(PlacedMedium boundary) { setBoundary(boundary); }

  PlacedMedium boundary() const { return boundary_; }
  void setBoundary(PlacedMedium medium);
  void enter(PlacedMedium medium);
  /// False when the medium was not present.
  bool leave(PlacedMedium medium);
  /// How often a medium of the rules Add and Priority is entered.
  std::size_t count(PlacedMedium medium) const;
  std::size_t enteredCount() const { return entered_.size(); }
  PlacedMedium entered(std::size_t i) const { return entered_[i]; }

  /// The media that count: the boundary medium, everything under the rule Add, and of those under the rule
  /// Priority the highest (once; of equal priorities the one whose name sorts first). Order does not depend
  /// on the direction of travel beyond the order of entering.
  std::size_t activeCount() const { return active_.size(); }
  PlacedMedium active(std::size_t i) const { return active_[i]; }
  bool isVacuum() const { return active_.size() == 0; }
  /// Whether all active media follow the exponential law.
  bool isExponential() const;
  /// Whether some active medium emits.
  bool isEmissive() const;
  /// Same media present, whatever the order of entering.
  bool operator==(const MediumState& o) const;
  /// "smoke + fog", or "vacuum".
  std::string describe() const;

 private:
  /// A few elements in place, more on the heap.
  class List {
   public:
    std::size_t size() const { return size_; }
    PlacedMedium operator[](std::size_t i) const { return i < kInline ? inline_[i] : heap_[i - kInline]; }
    void push(PlacedMedium m);
    void erase(std::size_t i);
    void clear();

   private:
    static constexpr std::size_t kInline = 4;
    void set(std::size_t i, PlacedMedium m) { (i < kInline ? inline_[i] : heap_[i - kInline]) = m; }
    std::array<PlacedMedium, kInline> inline_{};
    std::vector<PlacedMedium> heap_;
    std::size_t size_ = 0;
  };
  void refresh();

  PlacedMedium boundary_;
  List entered_, active_;
};

}  // namespace pbrtmedia
