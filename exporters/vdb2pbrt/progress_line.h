// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>

namespace pbrtmedia {

/// Tells what a long run is doing. On a terminal one line is drawn over and over, ten times a second at most
/// and never wider than the terminal; elsewhere a line is written every five seconds. What is done sooner is
/// not told.
class ProgressLine {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;
  /// `columns`: width of the terminal, 0: `out` is none.
  ProgressLine(std::ostream& out, int columns, Clock clock = std::chrono::steady_clock::now);
  /// For standard error.
  static ProgressLine onStandardError();

  /// `share` in [0, 1], or negative where it is not known.
  void update(const std::string& what, double share);
  /// Takes the line off the terminal, before other text and at the end.
  void clear();

 private:
  std::ostream& out_;
  int columns_;
  Clock clock_;
  std::chrono::steady_clock::time_point last_;
  bool shown_ = false;
};

}  // namespace pbrtmedia
