// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson_walk.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Ratio tracking: the product of (1 - sigma_t rho(x_i) / majorant) over the points x_i of a Poisson process
/// whose rate is the local majorant, that is the largest channel's sigma_t times the super-voxel bound.
/// Novák, Selle & Jarosz 2014, doi:10.1145/2661229.2661292; Georgiev et al. 2019, Eq. (5); here with
/// piecewise constant majorants, one weight per channel, and an optional roulette that ends walks of little
/// weight.
///
/// Bias: none, wherever the bounds are positive. Range: [0, 1] while bounds hold (without roulette); any sign
/// and more variance beyond. Variance in one channel, without roulette: T^2 expm1(integral of mu^2 /
/// majorant). Cost: the optical depth of the majorant at most, and no more behind a product of exactly 0, as
/// a density that is its bound leaves it; empty cells cost no look-up, and vacuum is exactly 1.
struct RatioTracking {
  static constexpr std::string_view kName = "ratio";

  /// Below this weight a walk survives with probability weight / threshold and then weighs `threshold`.
  /// 0: no roulette; a walk still ends where its weight is exactly 0.
  double rouletteThreshold = 0;
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{
        Parameter{"roulettethreshold", &RatioTracking::rouletteThreshold,
                  "weight below which a walk may end, the survivors weighing this; 0: never", 0, 1},
        Parameter{"maxlookups", &RatioTracking::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "product of the null shares of the tentative collisions of one walk",
            .source = "Novák et al. 2014; Georgiev et al. 2019 (5)",
            .useWhen = "look-ups are cheap and bounds local: little work, variance moderate everywhere",
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
    Channels<N>& weight = estimate.value;
    LookupTally& tally = estimate.tally;
    const LookupLimit limit(maxLookups);
    PoissonWalk walk(stream);
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      if (!(bound.upper > 0)) {
        probeTrusted(line, sEnter, sExit, 0, stream.rng(), tally);
        return true;
      }
      const double upper = bound.upper;
      return walk.crossByInverse(sEnter, sExit, sigmaMax * upper, [&](double s) {
        if (limit.reached(tally)) return false;
        // Divided, not multiplied by 1 / upper: a density that is its bound leaves exactly nothing.
        const Channels<N> null = nullShares(share, boundedLookup(line, s, upper, tally) / upper);
        ++tally.nullCollisions;
        for (std::size_t c = 0; c < N; ++c) weight[c] *= null[c];
        return survives(weight, stream);
      });
    });
    return estimate;
  }

 private:
  template <std::size_t N>
  bool survives(Channels<N>& weight, SampleStream& stream) const {
    double largest = 0;
    for (const double w : weight) largest = std::max(largest, w < 0 ? -w : w);
    // Beyond the range of double nothing that follows can repair the product; infinity times 0 never forms.
    if (!(largest <= std::numeric_limits<double>::max())) return false;
    if (largest >= rouletteThreshold && largest > 0) return true;
    if (largest > 0 && stream.uniform() * rouletteThreshold < largest) {
      const double boost = rouletteThreshold / largest;
      for (double& w : weight) w *= boost;
      return true;
    }
    weight = filled<N>(0);
    return false;
  }
};

}  // namespace pbrtmedia
