// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "main/options.h"
#include "render/ranks.h"

namespace pbrtmedia {

/// A failure whose messages are printed already; its text is for other processes.
class ShownFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What several processes that run the same program do in step: all read and build the scene for themselves,
/// the first speaks and writes for all, and what fails on one ends all of them, told once.
class Together {
 public:
  /// Must outlive the object.
  explicit Together(Ranks& ranks) : ranks_(ranks) {}

  Ranks& ranks() const { return ranks_; }
  bool isFirst() const { return ranks_.isFirst(); }

  /// Runs a part that every rank does for itself. Where it throws on any of them it throws on all: what it
  /// threw there, or else, on the first, std::runtime_error with the rank and its message.
  template <class Part>
  auto step(const Part& part) {
    if (ranks_.isAlone()) return part();
    std::exception_ptr thrown;
    if constexpr (std::is_void_v<decltype(part())>) {
      tryTo(part, thrown);
      agree(thrown);
    } else {
      std::optional<decltype(part())> answer;
      tryTo([&] { answer.emplace(part()); }, thrown);
      agree(thrown);
      return std::move(*answer);
    }
  }
  /// All get what the first answers.
  int decide(int ofFirst);
  /// A step has thrown: all know that it is over. Not where there is one rank.
  bool hasFailed() const { return hasFailed_; }
  /// This rank has come to the end.
  void noteEnd() { isOver_ = true; }
  /// Whether it leaves although others may wait for it, and not in a step.
  bool leavesAlone() const { return !isOver_ && !hasFailed_; }

 private:
  static void tryTo(const std::function<void()>& part, std::exception_ptr& thrown);
  void agree(const std::exception_ptr& thrown);

  Ranks& ranks_;
  bool hasFailed_ = false;  ///< in a step: all know that it is over
  bool isOver_ = false;
};

/// The other ranks stop so much later, seconds, that the first is never told by them.
constexpr double kLateness = .05;

/// What a rank that is not the first does of what the options ask: it writes and says nothing, and its time
/// ends a little later.
Options optionsOfOthers(Options options);

}  // namespace pbrtmedia
