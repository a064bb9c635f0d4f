// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "main/options.h"

namespace pbrtmedia {

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
  enum class Style { Live, Plain, Silent } style_;
  std::string title_;
  Clock::time_point start_, last_;
  bool shown_ = false;
};

/// "3.2s", "4m05s", "1h02m".
std::string formatDuration(double seconds);
/// "950", "12.3k", "4.56M".
std::string formatCount(double count);

}  // namespace pbrtmedia
