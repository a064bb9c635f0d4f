// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <variant>
#include <vector>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/any_exponential_estimator.h"
#include "transmittance/estimate.h"
#include "transmittance/estimate_on.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// A line that can be cut: `stretch(sEnter, sExit)` is the line of what lies between, its s from 0 on, 0 <=
/// sEnter < sExit <= length().
template <class L>
concept DivisibleLine = DensityLine<L> && requires(const L& line, double s) {
  { line.stretch(s, s) } -> std::same_as<L>;
};

/// The product of independent estimates of the intervals between super-voxel borders: what the renderer
/// published with Misso et al. 2023, doi:10.1145/3588432.3591557, does with every estimator (figure 9). There
/// the base sees one super-voxel at a time, where others see the whole line.
///
/// Bias: none, if the base has none: exp(-tau) is the product of that of parts, and means of independent
/// factors multiply. Second moments do too: E[T^2] = prod_i E[T_i^2]; so walks that forget where they began
/// (ratio tracking) are what they were, while what series and marches know of a whole line is lost. Range:
/// that of the base. Cost: the sum of the base's, which is at least its least for each interval; none where a
/// proven bound is 0. A limit on look-ups is one of each interval. A line that is no DivisibleLine:
/// std::logic_error.
struct IntervalProduct {
  static constexpr std::string_view kName = "interval-product";

  AnyExponentialEstimator base = {};

  EstimatorTraits traits() const;

  /// `base`, a keyword, then the parameters of the base (parameters.h).
  std::vector<ParameterDescription> describe() const;
  /// Naming a base resets its parameters.
  AssignResult assign(std::string_view name, const ParameterValue& value);

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    if constexpr (DivisibleLine<Line>) {
      line.walk([&](double sEnter, double sExit, const auto& bound) {
        if (!(bound.upper > 0) && line.hasProvenBounds()) return true;
        multiply(estimate, ofInterval(line.stretch(sEnter, sExit), sigmaT, stream), sEnter);
        return maxMagnitude(estimate) > 0;
      });
    } else {
      throw std::logic_error("this estimator needs a line that can be cut");
    }
    return estimate;
  }

 private:
  template <class Line, std::size_t N>
  Estimate<N> ofInterval(const Line& part, const Channels<N>& sigmaT, SampleStream& stream) const {
    return std::visit([&](const auto& estimator) { return estimateOn(estimator, part, sigmaT, stream); },
                      base);
  }
  /// `factor` is of a stretch that begins at `begin`.
  template <std::size_t N>
  static void multiply(Estimate<N>& product, const Estimate<N>& factor, double begin) {
    for (std::size_t c = 0; c < N; ++c) {
      // Behind an opaque interval nothing counts, not even what has left the range of double.
      double& value = product.value[c];
      value = value == 0 || factor.value[c] == 0 ? 0 : value * factor.value[c];
    }
    LookupTally& sum = product.tally;
    const LookupTally& more = factor.tally;
    sum.lookups += more.lookups;
    sum.nullCollisions += more.nullCollisions;
    sum.capped = std::max(sum.capped, more.capped);  // estimates, not intervals
    if (more.violations == 0) return;
    sum.noteViolation(begin + more.worstS, more.worstDensity, more.worstBound);
    sum.violations += more.violations - 1;
  }
  template <std::size_t N>
  static double maxMagnitude(const Estimate<N>& estimate) {
    double most = 0;
    for (const double v : estimate.value) most = std::max(most, v < 0 ? -v : v);
    return most;
  }
};

}  // namespace pbrtmedia
