// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "base/stopwatch.h"
#include "render/render_options.h"
#include "render/render_result.h"

namespace pbrtmedia {

/// Sample indices [first, first + count) of every pixel; or iterations, or mutations per pixel.
struct Pass {
  std::int64_t first = 0;
  int count = 0;
};

/// Which samples are to be taken, in passes of which size, and when to stop early.
class Schedule {
 public:
  struct Plan {
    std::int64_t first = 0, end = 0;  ///< sample indices
    std::int64_t mostPerPass = 1;     ///< what memory allows, or a pass may have; >= 1
  };

  /// `options` must outlive the object; the time runs from now on.
  Schedule(const Plan& plan, const RenderOptions& options);

  /// The next pass; nothing when all samples are scheduled or it is time to stop. `lookups`: so far.
  std::optional<Pass> next(std::uint64_t lookups);
  /// Why no further pass should begin; None: no reason.
  EarlyStop reasonToStop(std::uint64_t lookups) const;
  /// Whether to leave at once what is under way. Thread-safe, cheap enough for each sample.
  bool shouldStop() const;
  /// Of rendering so far.
  double seconds() const { return watch_.seconds() - elsewhere_.wall; }
  /// The same, with those of all threads.
  PhaseTime time() const;
  /// Some of what passed was no time of rendering.
  void leaveOut(const PhaseTime& time) { elsewhere_ += time; }

 private:
  bool isTimed() const;
  std::int64_t passSize(std::uint64_t lookups) const;

  Plan plan_;
  const RenderOptions& options_;
  Stopwatch watch_;
  PhaseTime elsewhere_;
  std::int64_t begin_;  ///< the first sample index of this part of the render
  int passes_ = 0;
};

}  // namespace pbrtmedia
