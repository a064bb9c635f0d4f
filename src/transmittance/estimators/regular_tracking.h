// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/law.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Regular tracking: the optical depth piece by piece. On each piece the density is a cubic in t (trilinear
/// grids, cell by cell), for which two-point Gauss-Legendre quadrature is exact. The ground truth of every
/// test on grids. Empty super-voxels cost nothing.
///
/// Bias and variance: none, up to rounding. Cost: two look-ups per crossed piece; under the exponential law
/// it ends once every channel's transmittance is below the smallest double.
struct RegularTracking {
  static constexpr std::string_view kName = "regular";
  /// exp(-x) is 0 in double beyond this.
  static constexpr double kOpaque = 746;

  AnyLaw law;
  /// No parameter: collisionEstimatorOf().
  LawCurve curve = LawCurve::Transmittance;

  EstimatorTraits traits() const {
    return {.summary = "the law at the exact optical depth, integrated piece by piece",
            .source = "Amanatides & Woo 1987 for the walk; two-point Gauss-Legendre, exact for cubics",
            .useWhen = "truth is wanted, or the line crosses few voxels",
            .control = EstimatorTraits::Control::Unused,
            .boundedCost = true,
            .needsPieces = true,
            .laws = LawSet::all()};
  }

  template <PiecewiseCubicLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream&) const {
    Estimate<N> estimate;
    const bool isExponential = std::holds_alternative<ExponentialLaw>(law);
    const double enough = isExponential ? kOpaque / *std::min_element(sigmaT.begin(), sigmaT.end())
                                        : std::numeric_limits<double>::infinity();
    const double column = densityIntegral(line, enough, estimate.tally);
    // 0 * inf never forms: the integral of a finite density over a finite line is finite.
    for (std::size_t c = 0; c < N; ++c) estimate.value[c] = valueOf(curve, law, sigmaT[c] * column);
    return estimate;
  }

  /// Integral of the density over the line (unit of t); may stop early once above `enough`.
  template <PiecewiseCubicLine Line>
  static double densityIntegral(const Line& line, double enough, LookupTally& tally) {
    constexpr double kGauss = 0.57735026918962576451;  // 1/sqrt(3)
    double column = 0;
    line.walkPieces([&](double a, double b) {
      const double half = (b - a) / 2, middle = a + half;
      column += half * (static_cast<double>(line.density(middle - kGauss * half)) +
                        static_cast<double>(line.density(middle + kGauss * half)));
      tally.lookups += 2;
      return column <= enough;
    });
    return column;
  }
};

}  // namespace pbrtmedia
