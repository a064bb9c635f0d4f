// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/law.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/running_product.h"
#include "transmittance/parts/term_roulette.h"
#include "transmittance/parts/upper_control.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// P-series cumulative estimation of pink-noise transmittance: terms of its Taylor series about the optical
/// depth alpha of the majorant, each from the one before by one more independent point of density
/// proportional to the majorant,
///   W_k = W_{k-1} alpha (mu_n / majorant)(x_k) (1 + (k-1) C^2) / (k (1 + alpha C^2)),
/// continued with probability P = min(|W_k|, 1) and then divided by it; g(alpha) times the sum of all W. The
/// series: Misso et al. 2022, doi:10.1145/3528223.3530160, Eq. (25), the points and the roulette: Georgiev et
/// al. 2019, Eq. (30), which it is for C = 0. Ours where the paper gives no details: each channel has its own
/// alpha and shares the points, P is from the largest |W_k|.
///
/// Bias: none under a bounding control; under one that is too low by a factor b as long as E|mu_n / majorant|
/// < 1 + 1 / (alpha C^2) on average over the points (so b >= 1/2 always suffices). Beyond, the series
/// diverges; having found a violation, it is then cut where it should long have ended, and counted. Range:
/// any. Cost: at least 1 look-up, of order alpha log(1 + alpha C^2) in a medium much thinner than its bound.
struct PinkPCumulative {
  static constexpr std::string_view kName = "pink-p-cumulative";

  PinkNoiseLaw law = {};
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &PinkPCumulative::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "the Taylor series of pink noise term by term, ended by a roulette on the term's size",
            .source = "Misso et al. 2022 (25); Georgiev et al. 2019 (30)",
            .useWhen = "the law is pink noise and bounds are tight",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = true,
            .control = EstimatorTraits::Control::Any,
            .finiteVarianceUnbounded = false,
            .boundedCost = maxLookups > 0,
            .laws = LawSet::pinkNoise()};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT), c2 = law.correlation * law.correlation;
    UpperControl<Line, 1> control(line, {sigmaMax}, stream, estimate.tally);
    const double depth = control.depth();
    if (!(depth > 0)) return estimate;
    Channels<N> step;  // alpha / (1 + alpha C^2)
    std::array<RunningProduct, N> weight;
    for (std::size_t c = 0; c < N; ++c) {
      const double alpha = depth * (sigmaT[c] / sigmaMax);
      step[c] = alpha / (1 + alpha * c2);
      weight[c] = RunningProduct(law.logarithm(alpha));
      estimate.value[c] = weight[c].value();
    }
    const LookupLimit limit(maxLookups);
    const double patience = kPatience * (1 + depth) * (1 + std::log1p(depth * c2));
    for (double k = 1; !limit.reached(estimate.tally); ++k) {
      const double null = control.nullRatio(stream.uniform() * depth)[0], factor = null * law.growth(k);
      double size = 0;
      for (std::size_t c = 0; c < N; ++c) {
        weight[c].multiply(step[c] * factor);
        size = std::max(size, weight[c].magnitude());
      }
      const double survival = survivalFactor(size, stream);
      if (!(survival > 0)) break;
      for (std::size_t c = 0; c < N; ++c) {
        if (survival > 1) weight[c].multiply(survival);
        addTerm(estimate.value[c], weight[c].value());
      }
      if (estimate.tally.violations > 0 && k > patience) {
        estimate.tally.capped = 1;
        break;
      }
    }
    return estimate;
  }

 private:
  /// Look-ups per alpha log(1 + alpha C^2) that a convergent series stays far below.
  static constexpr double kPatience = 64;
};

}  // namespace pbrtmedia
