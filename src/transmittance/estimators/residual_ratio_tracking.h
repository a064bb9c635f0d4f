// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson_walk.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Residual ratio tracking: the lower bounds of the super-voxels are integrated, ratio tracking sees what is
/// left above them. exp(-sigma_t integral of lower) times the product of 1 - sigma_t (rho(x_i) - lower) /
/// rate over the points x_i of a Poisson process with the rate sigma_t (upper - lower) of the largest
/// channel. Novák, Selle & Jarosz 2014; Georgiev et al. 2019, Eq. (6); Kettunen et al. 2021, Eq. (10).
/// Stretches with upper = lower are exact and cost nothing; unproven ones are probed once. An optional
/// roulette ends walks of little weight, the integrated lower bounds being part of it.
///
/// Bias: none for any lower <= upper, true bounds or not, that differ where the density differs from them.
/// Range: [0, 1] while bounds hold. Variance in one channel, without roulette: T^2 expm1(integral of
/// (mu - mu_c)^2 / (majorant - mu_c)). Cost: at most the optical depth of majorant - minorant.
struct ResidualRatioTracking {
  static constexpr std::string_view kName = "residual-ratio";

  /// Below this weight a walk survives with probability weight / threshold and then weighs `threshold`.
  /// 0: no roulette; a walk still ends where its weight is exactly 0.
  double rouletteThreshold = 0;
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{
        Parameter{"roulettethreshold", &ResidualRatioTracking::rouletteThreshold,
                  "weight below which a walk may end, the survivors weighing this; 0: never", 0, 1},
        Parameter{"maxlookups", &ResidualRatioTracking::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "minorants integrated, ratio tracking on what is left above them",
            .source = "Novák et al. 2014; Georgiev et al. 2019 (6); Kettunen et al. 2021 (10)",
            .useWhen = "bounds are local and the density seldom falls to 0: fewer look-ups than ratio",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = false,
            .control = EstimatorTraits::Control::Any,
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return estimate;
    const Channels<N> share = sharesOf(sigmaT, sigmaMax);
    LookupTally& tally = estimate.tally;
    const LookupLimit limit(maxLookups);
    ChannelProducts<N> weight;
    double minorant = 0;  // integral of the lower bounds
    double asked = 0;     // minorant at the last roulette
    const auto survives = [&] {
      if (!(rouletteThreshold > 0)) return !weight.isZero();
      asked = minorant;
      return survivesRoulette(weight, sigmaT, minorant, stream);
    };
    PoissonWalk walk(stream);
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      const double upper = bound.upper, lower = bound.lower, excess = upper - lower;
      minorant += (sExit - sEnter) * lower;
      if (!(excess > 0)) {
        probeTrusted(line, sEnter, sExit, upper, stream.rng(), tally);
        return true;
      }
      if (tally.capped != 0) return true;
      if (sigmaMax * (minorant - asked) > kRouletteDepth && !survives()) return false;
      walk.cross(sEnter, sExit, sigmaMax * excess, [&](double s) {
        if (limit.reached(tally)) return false;
        const double ratio = (boundedLookup(line, s, upper, tally) - lower) / excess;
        ++tally.nullCollisions;
        weight.multiply(nullShares(share, ratio));
        return survives();
      });
      return !weight.isZero();
    });
    estimate.value = weight.attenuated(sigmaT, minorant);
    return estimate;
  }

 private:
  /// Optical depth of minorants after which one asks between collisions too.
  static constexpr double kRouletteDepth = 0.5;

  template <std::size_t N>
  bool survivesRoulette(ChannelProducts<N>& weight, const Channels<N>& sigmaT, double minorant,
                        SampleStream& stream) const {
    double largest = 0;
    for (const double w : weight.attenuated(sigmaT, minorant)) largest = std::max(largest, std::abs(w));
    if (largest >= rouletteThreshold) return true;
    if (largest > 0 && stream.uniform() * rouletteThreshold < largest) {
      weight.multiply(rouletteThreshold / largest);
      return true;
    }
    weight.multiply(0);
    return false;
  }
};

}  // namespace pbrtmedia
