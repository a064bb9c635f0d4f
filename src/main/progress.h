// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "main/options.h"

namespace pbrtmedia {

enum class ProgressStyle { Live, Plain, Silent };
/// Live on a terminal, plain text elsewhere, unless the user says otherwise.
ProgressStyle progressStyle(ProgressMode mode, bool quiet);

/// One line for a terminal of `columns` columns, never longer than columns - 1: the bar and the title
/// are shortened first (names in the middle), then the bar goes, then the end of the numbers. `fraction` in
/// [0, 1].
std::string liveLine(const std::string& title, double fraction, const std::string& numbers, int columns);

/// Says that a phase without a known end (reading, building) goes on: on a terminal after half a second, in
/// place; as plain text every five seconds. A thread of its own prints until the destructor erases the line.
/// Nothing else may print meanwhile.
class PhaseLine {
 public:
  /// `text`: "reading smoke.pbrt".
  PhaseLine(ProgressMode mode, bool quiet, std::string text);
  PhaseLine(const PhaseLine&) = delete;
  PhaseLine& operator=(const PhaseLine&) = delete;
  ~PhaseLine();

 private:
  void print();

  ProgressStyle style_;
  std::string text_;
  std::mutex mutex_;
  std::condition_variable over_;
  bool isOver_ = false;
  std::thread printer_;
};

/// The progress line on standard error. On a terminal it is redrawn in place ten times a second at most; as
/// plain text a line appears every five seconds. Called from one thread at a time.
class ProgressLine {
 public:
  ProgressLine(ProgressMode mode, bool quiet, std::string title);
  /// `done` and `total` in samples of the whole film; `timeLimit` in seconds, 0: none.
  void update(std::int64_t done, std::int64_t total, double timeLimit);
  /// Ends the line (terminal) or prints the last one (plain).
  void finish(std::int64_t done, std::int64_t total);

 private:
  using Clock = std::chrono::steady_clock;
  ProgressStyle style_;
  std::string title_;
  Clock::time_point start_, last_;
  bool shown_ = false;
};

/// "3.2s", "4m05s", "1h02m".
std::string formatDuration(double seconds);
/// "950", "12.3k", "4.56M".
std::string formatCount(double count);

}  // namespace pbrtmedia
