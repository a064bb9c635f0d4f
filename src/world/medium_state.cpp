// SPDX-License-Identifier: BSD-2-Clause
#include "world/medium_state.h"

#include "media/medium.h"

namespace pbrtmedia {

void MediumState::List::push(PlacedMedium m) {
  if (size_ < kInline) {
    inline_[size_] = m;
  } else {
    heap_.push_back(m);
  }
  ++size_;
}

void MediumState::List::erase(std::size_t i) {
  for (; i + 1 < size_; ++i) set(i, (*this)[i + 1]);
  if (size_ > kInline) heap_.pop_back();
  --size_;
}

void MediumState::List::clear() {
  heap_.clear();
  size_ = 0;
}

void MediumState::setBoundary(PlacedMedium medium) {
  boundary_ = medium.medium ? medium : PlacedMedium{};
  refresh();
}

void MediumState::enter(PlacedMedium medium) {
  entered_.push(medium);
  refresh();
}

bool MediumState::leave(PlacedMedium medium) {
  for (std::size_t i = entered_.size(); i-- > 0;) {
    if (!(entered_[i] == medium)) continue;
    entered_.erase(i);
    refresh();
    return true;
  }
  return false;
}

std::size_t MediumState::count(PlacedMedium medium) const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < entered_.size(); ++i) n += entered_[i] == medium ? 1 : 0;
  return n;
}

namespace {

/// Whether `a` hides `b` where both are present.
bool outranks(const Medium& a, const Medium& b) {
  if (a.overlap().priority != b.overlap().priority) return a.overlap().priority > b.overlap().priority;
  return a.name() < b.name();
}

}  // namespace

void MediumState::refresh() {
  active_.clear();
  if (boundary_.medium) active_.push(boundary_);
  PlacedMedium highest;
  for (std::size_t i = 0; i < entered_.size(); ++i) {
    const PlacedMedium m = entered_[i];
    if (m.medium->overlap().mode != OverlapRule::Mode::Priority) {
      active_.push(m);
    } else if (!highest.medium || outranks(*m.medium, *highest.medium)) {
      highest = m;
    }
  }
  if (highest.medium) active_.push(highest);
}

bool MediumState::isExponential() const {
  for (std::size_t i = 0; i < activeCount(); ++i) {
    if (!active(i).medium->isExponential()) return false;
  }
  return true;
}

bool MediumState::isEmissive() const {
  for (std::size_t i = 0; i < activeCount(); ++i) {
    if (active(i).medium->isEmissive()) return true;
  }
  return false;
}

bool MediumState::operator==(const MediumState& o) const {
  if (!(boundary_ == o.boundary_) || entered_.size() != o.entered_.size()) return false;
  for (std::size_t i = 0; i < entered_.size(); ++i) {
    if (count(entered_[i]) != o.count(entered_[i])) return false;
  }
  return true;
}

std::string MediumState::describe() const {
  if (isVacuum()) return "vacuum";
  std::string text;
  for (std::size_t i = 0; i < activeCount(); ++i) {
    text += (i > 0 ? " + \"" : "\"") + active(i).medium->name() + '"';
  }
  return text;
}

}  // namespace pbrtmedia
