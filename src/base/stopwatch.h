// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace pbrtmedia {

/// Wall and CPU seconds (all threads of the process) of one phase.
struct PhaseTime {
  double wall = 0, cpu = 0;
  PhaseTime& operator+=(const PhaseTime& o) {
    wall += o.wall;
    cpu += o.cpu;
    return *this;
  }
};

/// Runs from construction on.
class Stopwatch {
 public:
  Stopwatch();
  PhaseTime elapsed() const;
  /// Wall-clock seconds alone: cheap enough to ask for each sample.
  double seconds() const;

 private:
  std::chrono::steady_clock::time_point wall_;
  double cpu_;
};

/// Largest resident size of the process so far, bytes.
std::size_t peakMemoryBytes();
/// Memory of the machine, bytes; the largest number where the system does not tell.
std::uint64_t machineMemoryBytes();

}  // namespace pbrtmedia
