// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// The points of a Poisson process along a line, in order. The rate is constant on each stretch handed over;
/// what a stretch leaves of the way to the next point carries over to the one behind. Borrows the stream; one
/// dimension of it a point.
class PoissonWalk {
 public:
  explicit PoissonWalk(SampleStream& stream) : stream_(&stream), depth_(stream.exponential()) {}

  /// Calls visit(s) for the points in [sEnter, sExit) until it answers false; answers whether it never did,
  /// after which the walk is over. rate: >= 0, per unit of s.
  template <class Visit>
  bool cross(double sEnter, double sExit, double rate, Visit&& visit) {
    for (double s = sEnter;;) {
      const double depthToExit = (sExit - s) * rate;
      if (depth_ >= depthToExit) {
        depth_ -= depthToExit;
        return true;
      }
      s += depth_ / rate;
      if (!visit(s)) return false;
      depth_ = stream_->exponential();
    }
  }

 private:
  SampleStream* stream_;
  double depth_;  ///< what the integral of the rate has to grow by until the next point
};

}  // namespace pbrtmedia
