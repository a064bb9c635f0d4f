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
    return crossBy(
        sEnter, sExit, rate, [rate](double depth) { return depth / rate; }, visit);
  }
  /// The same, for who crosses dense stretches: steps are multiplied by 1 / rate. rate: > 0.
  template <class Visit>
  bool crossByInverse(double sEnter, double sExit, double rate, Visit&& visit) {
    return crossBy(
        sEnter, sExit, rate, [inverse = 1 / rate](double depth) { return depth * inverse; }, visit);
  }

 private:
  template <class StepOf, class Visit>
  bool crossBy(double sEnter, double sExit, double rate, const StepOf& stepOf, Visit& visit) {
    for (double s = sEnter;;) {
      const double depthToExit = (sExit - s) * rate;
      if (depth_ >= depthToExit) {
        depth_ -= depthToExit;
        return true;
      }
      s += stepOf(depth_);
      if (!visit(s)) return false;
      depth_ = stream_->exponential();
    }
  }

  SampleStream* stream_;
  double depth_;  ///< what the integral of the rate has to grow by until the next point
};

}  // namespace pbrtmedia
