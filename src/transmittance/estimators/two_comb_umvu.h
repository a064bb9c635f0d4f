// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "transmittance/paired_estimate.h"
#include "transmittance/parts/comb_march.h"
#include "transmittance/parts/comb_size.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Two combs and the uniformly minimum-variance unbiased estimate of exp of a normal mean: e^{(X_1 + X_2)/2}
/// cos((X_1 - X_2)/2), X_i the combs' estimates of minus the optical depth. Peters 2025.
///
/// Bias: none if X is normal, as E[cos(D/2)] = e^{-s^2/4} for D ~ N(0, 2 s^2) undoes E[e^{(X_1+X_2)/2}] = T
/// e^{s^2/4}. In general the mean is T |M((1 + i)/2)|^2, M the moment generating function of X + tau: a bias
/// of about -T (k_3 / 12 + k_4 / 48), k_j its cumulants, where biased ray marching has T k_2 / 2. Range: any
/// sign. Cost: deterministic, what p-series CMF spends on average, half of it on each comb.
struct TwoCombUmvu {
  static constexpr std::string_view kName = "two-comb-umvu";

  Comb comb = Comb::Equidistant;
  EndpointMatching endpointMatching = EndpointMatching::Auto;
  std::uint64_t tupleSize = 0;
  Warp warp = Warp::Auto;
  std::uint64_t maxLookups = 0;

  static constexpr auto parameters() {
    using Self = TwoCombUmvu;
    return std::tuple{Parameter{"comb", &Self::comb, CombSettings::kCombHelp},
                      Parameter{"endpointmatching", &Self::endpointMatching, CombSettings::kMatchingHelp},
                      Parameter{"tuplesize", &Self::tupleSize,
                                "look-ups of each comb; 0: half of what p-series CMF spends", 0, 0x1p32},
                      Parameter{"warp", &Self::warp, CombSettings::kWarpHelp},
                      Parameter{"maxlookups", &Self::maxLookups, CombMarch::kLimitHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "two combs joined so that normal noise of the optical depth causes no bias",
            .source = "Peters 2025",
            .useWhen = "every ray should cost the same, with less bias than biased-ray-marching",
            .bias = EstimatorTraits::Bias::Consistent,
            .biasNote =
                "none for normal noise, of third order otherwise: -T k_3 / 12, k_3 the third cumulant of one "
                "comb's depth",
            .mayLeaveUnitInterval = true,
            .control = EstimatorTraits::Control::CostOnly,
            .boundedCost = tupleSize > 0 || maxLookups > 0,
            .tellsSpread = true};
  }

  /// Mean e^{E[x]} for two independent normal x1, x2 of one mean and variance.
  static double combine(double x1, double x2) { return std::exp((x1 + x2) / 2) * std::cos((x1 - x2) / 2); }
  /// The imaginary part of the same exponential, e^{m + i d}, m = (x1 + x2)/2 and d = (x1 - x2)/2: its square
  /// has the mean E[e^{2m} sin² d] = T² sinh(s²/2) e^{s²/2}, s² the variance of x1, the variance of
  /// `combine`.
  static double spread(double x1, double x2) { return std::exp((x1 + x2) / 2) * std::sin((x1 - x2) / 2); }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    return march(line, sigmaT, stream, [](std::size_t, double, double) {});
  }
  /// The same estimate, with what its two combs say of its noise. The same look-ups.
  template <DensityLine Line, std::size_t N>
  PairedEstimate<N> paired(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    PairedEstimate<N> estimate;
    const Estimate<N> marched = march(line, sigmaT, stream, [&](std::size_t c, double x1, double x2) {
      estimate.spread[c] = spread(x1, x2);
    });
    estimate.value = marched.value;
    estimate.tally = marched.tally;
    return estimate;
  }

 private:
  /// `note(c, x1, x2)`: is told both estimates of minus the depth in channel `c`.
  template <DensityLine Line, std::size_t N, class Note>
  Estimate<N> march(const Line& line, const Channels<N>& sigmaT, SampleStream& stream,
                    const Note& note) const {
    const auto teethUnder = [&](double control) {
      return tupleSize > 0 ? static_cast<double>(tupleSize) : pSeriesCmfLookups(control) / 2 + 0.5;
    };
    return CombMarch{{comb, endpointMatching, warp}, maxLookups}(
        line, sigmaT, stream, teethUnder, [&](auto& combs) {
          const double first = combs.integral(), second = combs.integral();
          Channels<N> value;
          for (std::size_t c = 0; c < N; ++c) {
            value[c] = combine(-sigmaT[c] * first, -sigmaT[c] * second);
            note(c, -sigmaT[c] * first, -sigmaT[c] * second);
          }
          return value;
        });
  }
};

}  // namespace pbrtmedia
