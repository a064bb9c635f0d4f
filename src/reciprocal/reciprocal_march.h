// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/math.h"
#include "base/parameters.h"
#include "reciprocal/per_channel.h"
#include "reciprocal/reciprocal_function.h"
#include "reciprocal/reciprocal_traits.h"
#include "transmittance/parts/nested_march.h"
#include "transmittance/parts/vacuum.h"

namespace pbrtmedia {

/// The reciprocal of one march: what the debiased estimators are to be compared with.
///
/// Bias: about Var[F_i] / F^3, upwards; infinite where a march may find nothing. Cost: n.
struct ReciprocalMarch {
  static constexpr std::string_view kName = "reciprocal-march";

  std::uint64_t n = 32;
  Comb comb = Comb::Equidistant;

  static constexpr auto parameters() {
    return std::tuple{Parameter{"n", &ReciprocalMarch::n, "look-ups of the march", 1, std::uint64_t{1} << 24},
                      Parameter{"comb", &ReciprocalMarch::comb, CombSettings::kCombHelp}};
  }
  ReciprocalTraits traits() const {
    return {.summary = "the reciprocal of one march",
            .source = "the biased estimate that Misso et al. 2022 begin with",
            .useWhen = "a small bias does no harm, or to see what debiasing costs",
            .bias = EstimatorTraits::Bias::Consistent,
            .biasNote = "about Var[F_i] / F^3, upwards; falls with n",
            .domain = "densities above 0 everywhere",
            .control = EstimatorTraits::Control::Unused,
            .needsPositiveDensity = true,
            .varianceNote = "on densities bounded away from 0",
            .cost = "n",
            .boundedCost = true};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate{.value = filled<N>(kInfinity), .tally = {}};
    if (isVacuum(line, stream.rng(), estimate.tally)) return estimate;
    NestedMarch(comb, n, 0)(line, stream, estimate.tally, [&](double integral) {
      estimate.value = reciprocalPerChannel(sigmaT, ReciprocalFunction{}(integral));
    });
    return estimate;
  }
};

}  // namespace pbrtmedia
