// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "transmittance/law.h"
#include "transmittance/parts/comb_march.h"
#include "transmittance/parts/comb_size.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Biased ray marching: g(F) for one comb's estimate F of the optical depth, with as many look-ups as
/// p-series CMF would spend: the zeroth order of unbiased ray marching, under any law g. Kettunen et al.
/// 2021, algorithm 6.
///
/// Bias: about g''(tau) Var[F] / 2, for the exponential law T Var[F] / 2, upwards; none in a constant medium,
/// and none in a linear one with matched end points. Range: [0, 1] but for end point matching, which may make
/// F negative in the exponential law. Cost: pSeriesCmfLookups of majorant minus minorant, and two for end
/// points.
struct BiasedRayMarching {
  static constexpr std::string_view kName = "biased-ray-marching";

  Comb comb = Comb::Equidistant;
  EndpointMatching endpointMatching = EndpointMatching::Auto;
  std::uint64_t tupleSize = 0;
  Warp warp = Warp::Auto;
  std::uint64_t maxLookups = 0;
  AnyLaw law = {};
  /// No parameter: collisionEstimatorOf().
  LawCurve curve = LawCurve::Transmittance;

  static constexpr auto parameters() {
    using Self = BiasedRayMarching;
    return std::tuple{Parameter{"comb", &Self::comb, CombSettings::kCombHelp},
                      Parameter{"endpointmatching", &Self::endpointMatching, CombSettings::kMatchingHelp},
                      Parameter{"tuplesize", &Self::tupleSize, CombMarch::kTeethHelp, 0, 0x1p32},
                      Parameter{"warp", &Self::warp, CombSettings::kWarpHelp},
                      Parameter{"maxlookups", &Self::maxLookups, CombMarch::kLimitHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "the law at the optical depth that one comb estimates, as costly as p-series CMF",
            .source = "Kettunen et al. 2021, algorithm 6",
            .useWhen = "the least error per look-up counts and a small bias is acceptable",
            .bias = EstimatorTraits::Bias::Consistent,
            .biasNote = "T Var[F] / 2 upwards, F one comb's optical depth; vanishes with more teeth",
            .mayLeaveUnitInterval = endpointMatching != EndpointMatching::Off,
            .control = EstimatorTraits::Control::CostOnly,
            .boundedCost = tupleSize > 0 || maxLookups > 0,
            .laws = LawSet::all()};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    const auto teethUnder = [&](double control) {
      return tupleSize > 0 ? static_cast<double>(tupleSize) : pSeriesCmfLookups(control);
    };
    return CombMarch{{comb, endpointMatching, warp}, maxLookups}(
        line, sigmaT, stream, teethUnder, [&](auto& combs) {
          const double column = combs.integral();
          Channels<N> value;
          for (std::size_t c = 0; c < N; ++c) value[c] = valueOf(curve, law, sigmaT[c] * column);
          return value;
        });
  }
};

}  // namespace pbrtmedia
