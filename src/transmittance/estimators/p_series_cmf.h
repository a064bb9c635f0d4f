// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson.h"
#include "transmittance/parts/upper_control.h"

namespace pbrtmedia {

/// How many levels of the p-series CMF estimator are certain.
enum class LevelCount {
  Code,    ///< level i while Pr{Poisson(tau_bar) <= i-2} < 0.99: all published images
  Printed  ///< level i while Pr{Poisson(tau_bar) <= i-1} < 0.99: Georgiev et al. 2019, Eq. (31)
};
template <>
inline constexpr std::array kChoices<LevelCount>{std::string_view("code"), std::string_view("printed")};

/// P-series CMF estimation: the power series e^{-tau_bar} sum_k prod_{i<=k} f_i / (i P_i), f_i = tau_bar
/// (mu_n / majorant)(x_i) at independent points of density proportional to the majorant. The continuation P_i
/// is decided before the look-up: 1 for the levels that hold 99 % of a Poisson distribution of mean tau_bar,
/// then min(1, tau_bar / i). Georgiev et al. 2019, Eq. (31), section 5.3; here with piecewise constant
/// majorants and one weight per channel.
///
/// Bias: none, wherever the bounds are positive. Range: >= 0 while bounds hold, and may exceed 1. Variance in
/// one channel: with K certain levels, a_k = 1 / k! for k <= K and 1 / (K! tau_bar^(k-K)) beyond, P_k the
/// chance to reach level k, m and q the mean and mean square of f: e^{-2 tau_bar} sum_{j,k} a_j a_k
/// P_max(j,k) q^min(j,k) m^|j-k| - T^2; finite for any positive bounds. Cost: K + sum_j prod_{i=1..j} tau_bar
/// / (K+i) look-ups on average, whatever the medium; less where all products reach exactly 0.
struct PSeriesCmf {
  static constexpr std::string_view kName = "p-series-cmf";
  static constexpr double kCertainShare = 0.99;

  LevelCount levelCount = LevelCount::Code;
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"levelcount", &PSeriesCmf::levelCount,
                                "levels always evaluated: as in all published images (code), or one less "
                                "(printed)"},
                      Parameter{"maxlookups", &PSeriesCmf::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "the power series up to where its Poisson mass ends, then a roulette",
            .source = "Georgiev et al. 2019 (31)",
            .useWhen =
                "the medium is nearly constant, or bounds are loose and variance counts more than look-ups",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = true,
            .control = EstimatorTraits::Control::Any,
            .boundedCost = maxLookups > 0};
  }

  /// Levels that are evaluated in every estimate under a control of optical depth `depth` > 0.
  std::uint64_t certainLevels(double depth) const {
    return poissonQuantile(kCertainShare, depth) + (levelCount == LevelCount::Code ? 1 : 0);
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    UpperControl<Line, N> control(line, sigmaT, stream, estimate.tally);
    const double depth = control.depth();
    if (!(depth > 0)) return estimate;
    const LookupLimit limit(maxLookups);
    const double certain = static_cast<double>(certainLevels(depth));
    ChannelProducts<N> weight(-depth);
    estimate.value = filled<N>(0);
    weight.addTo(estimate.value);
    for (double i = 1; !weight.isZero(); ++i) {
      const double next = depth / i, probability = i <= certain || next > 1 ? 1 : next;
      if (probability < 1 && stream.uniformAboveZero() > probability) break;
      if (limit.reached(estimate.tally)) break;
      weight.multiply(control.nullRatio(stream.uniform() * depth), next / probability);
      weight.addTo(estimate.value);
    }
    return estimate;
  }
};

}  // namespace pbrtmedia
