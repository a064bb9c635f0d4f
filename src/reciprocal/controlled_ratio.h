// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/comb.h"
#include "transmittance/parts/upper_control.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Independent estimates of 1 - F / alpha on one line, where alpha is the integral of the upper control: the
/// mean of 1 - density / control over `n` points that a comb spreads in proportion to the control. Never
/// below 0 under a bounding control. Lives on the stack of one estimate; borrows line and tally.
template <DensityLine Line>
class ControlledRatio {
 public:
  ControlledRatio(const Line& line, std::uint64_t n, Comb comb, SampleStream& stream, LookupTally& tally)
      : control_(line, Channels<1>{1}, stream, tally), n_(n), comb_(comb), stream_(stream) {}

  /// Integral of the control over the line (unit of s); 0: nothing to divide by.
  double alpha() const { return control_.depth(); }
  /// One more estimate, n look-ups.
  double next() {
    const double offset = stream_.uniform(), inverse = 1 / static_cast<double>(n_);
    double sum = 0;
    for (std::uint64_t j = 0; j < n_; ++j) {
      const double share =
          place(static_cast<double>(j), j == 0 ? offset : ownOffset(offset), inverse, offset);
      sum += control_.nullRatio(share * alpha())[0];
    }
    return sum * inverse;
  }

 private:
  double ownOffset(double shared) {
    return comb_ == Comb::Stratified || comb_ == Comb::Independent ? stream_.uniform() : shared;
  }
  double place(double tooth, double own, double inverse, double shared) const {
    switch (comb_) {
      case Comb::Equidistant:
      case Comb::Stratified:
        return (own + tooth) * inverse;
      case Comb::Independent:
        return own;
      case Comb::GoldenRatio:
        break;
    }
    constexpr double kGolden = 0.61803398874989484820;
    const double turns = shared + tooth * kGolden;
    return turns - std::floor(turns);
  }

  UpperControl<Line, 1> control_;
  std::uint64_t n_;
  Comb comb_;
  SampleStream& stream_;
};

}  // namespace pbrtmedia
