// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>

namespace pbrtmedia {

/// When a side task is done again, so that it takes a small share of the time only.
class Pace {
 public:
  /// At most every `leastInterval` seconds, and for at most `share` of the time, in (0, 1].
  Pace(double leastInterval, double share) : leastInterval_(leastInterval), share_(share) {}

  /// `now`: seconds of any clock. The first time it is due at once.
  bool isDue(double now) const { return now >= next_; }
  /// The task was begun at `start` and took `cost` seconds.
  void done(double start, double cost) { next_ = start + interval(cost); }
  double interval(double cost) const { return std::max(leastInterval_, cost / share_); }

 private:
  double leastInterval_, share_;
  double next_ = -1e300;
};

}  // namespace pbrtmedia
