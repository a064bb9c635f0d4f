// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "tools/medialab/trials.h"

namespace pbrtmedia {

/// What a command has measured so far, in a file that outlives it (--resume): a run that was stopped or
/// killed goes on behind the last measurement that it finished. Measurements follow from their seeds, so the
/// table is that of an uninterrupted run, bit for bit except for seconds. Thread-safe.
///
/// The file is text: a line that says what it belongs to, then one line a measurement, appended and flushed
/// when it is done. A last line that was cut off is as if it had not been there.
class TrialJournal {
 public:
  /// Keeps nothing.
  TrialJournal() = default;
  /// Reads `file`, or begins it; empty: keeps nothing. `identity`: the measurements and the program, in a
  /// line. Throws std::runtime_error where the file is of another identity, no journal, or cannot be written.
  TrialJournal(const std::string& file, const std::string& identity);

  /// The measurement of that seed, which no other one of the command has.
  std::optional<TrialStats> find(std::uint64_t seed) const;
  void add(std::uint64_t seed, const TrialStats& stats);
  /// The measurement of that seed: found, or made by `measure` and kept unless `stop` cut it short.
  template <class Measure>
  TrialStats recall(std::uint64_t seed, const std::atomic<bool>& stop, const Measure& measure) {
    if (const std::optional<TrialStats> done = find(seed)) return *done;
    const TrialStats stats = measure();
    if (!stop) add(seed, stats);
    return stats;
  }

 private:
  std::string file_;
  mutable std::mutex mutex_;
  std::ofstream out_;
  std::unordered_map<std::uint64_t, TrialStats> done_;
};

}  // namespace pbrtmedia
