// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/math.h"
#include "base/parameters.h"
#include "reciprocal/controlled_ratio.h"
#include "reciprocal/per_channel.h"
#include "reciprocal/reciprocal_function.h"
#include "reciprocal/reciprocal_traits.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/taylor_roulette.h"

namespace pbrtmedia {

/// 1/F as its Taylor series about a pivot alpha: sum_j (alpha - F)^j / alpha^(j+1), powers being elementary
/// symmetric means of independent estimates F_i, or plain products of them. Orders below `terms` are certain;
/// then the series goes on with fixed probabilities. Misso et al. 2022, doi:10.1145/3528223.3530160, Eqs.
/// (4), (6); Booth 2007. A pivot that is itself an estimate, as for transmittance, is not offered: 1/F has a
/// singularity that such a pivot may come near.
///
/// Bias: none where E|1 - F_i/alpha| < 1, so for any pivot above half of every F_i. Variance: finite where
/// E[(1 - F_i/alpha)^2] < continuation. Cost: n E[N] look-ups, known beforehand: terms - 1 + correction / (1
/// - continuation) factors on average.
struct ReciprocalTaylor {
  static constexpr std::string_view kName = "reciprocal-taylor";
  using Orders = TaylorRouletteOf<ReciprocalFunction>;

  std::uint64_t n = 1;
  Comb comb = Comb::Equidistant;
  double pivotDepth = 0;  ///< of the largest channel; 0: the control's
  std::uint64_t terms = 3;
  double correctionProbability = 0.9;
  double continuation = 0.9;
  bool symmetrisation = true;
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    using Self = ReciprocalTaylor;
    return std::tuple{
        Parameter{"n", &Self::n, kReciprocalCountHelp, 1, 4096},
        Parameter{"comb", &Self::comb, kReciprocalCombHelp},
        Parameter{"pivotdepth", &Self::pivotDepth,
                  "optical depth about which the series is expanded, in the largest channel; 0: that of the "
                  "control",
                  0, 1e300},
        Parameter{"terms", &Self::terms, "terms of the series that every estimate evaluates", 1,
                  Orders::kMostTerms},
        Parameter{"correctionprobability", &Self::correctionProbability,
                  "probability of going on beyond these terms", 1e-3, 1},
        Parameter{"continuation", &Self::continuation, "probability of each term after that", 0.01, 0.999},
        Parameter{"symmetrisation", &Self::symmetrisation, Orders::kSymmetrisationHelp},
        Parameter{"maxlookups", &Self::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  ReciprocalTraits traits() const {
    return {.summary = "the Taylor series of 1/F about a pivot, its powers means of products of estimates",
            .source = "Misso et al. 2022 (4), (6); Booth 2007",
            .useWhen = "a pivot near F is known, such as the integral of a good approximation",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .domain =
                "E abs(1 - F_i/alpha) < 1: every density under a bounding control or a pivot above half of "
                "every F_i",
            .control = EstimatorTraits::Control::Any,
            .finiteVariance = false,
            .varianceNote = "finite where E (1 - F_i/alpha)^2 < continuation",
            .seriesLimit = pivotDepth > 0 ? 0 : continuation,
            .cost = "n (terms - 1 + correctionprobability / (1 - continuation))",
            .boundedCost = maxLookups > 0};
  }
  Orders orders() const { return {{}, terms, correctionProbability, symmetrisation, continuation}; }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate{.value = filled<N>(kInfinity), .tally = {}};
    const double sigmaMax = maxOf(sigmaT);
    ControlledRatio<Line> control(line, n, comb, stream, estimate.tally);
    if (!(control.alpha() > 0) || !(sigmaMax > 0)) return estimate;
    const LookupLimit limit(mostReciprocalLookups(maxLookups));
    const Orders series = orders();
    const std::uint64_t order = series.draw(stream.uniformAboveZero());
    std::vector<double> integrals;
    while (integrals.size() < order && !limit.reached(estimate.tally)) {
      integrals.push_back(control.alpha() * (1 - control.next()));
    }
    double reciprocal = 0;
    const double one = 1, pivot = pivotDepth > 0 ? pivotDepth / sigmaMax : control.alpha();
    series.sumAbout(pivot, integrals, std::span(&one, 1), std::span(&reciprocal, 1));
    estimate.value = reciprocalPerChannel(sigmaT, reciprocal);
    return estimate;
  }
};

}  // namespace pbrtmedia
