// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/running_product.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Adaptive ratio tracking: after a collision at x the rate is |majorant - mu(x)|, so few points are spent
/// where the last density seen was close to its bound. Steps of length d under the rate r weigh
/// exp((r - majorant) d), collisions weigh (majorant - mu(x)) / r. Misso et al. 2023, algorithm 2, with the
/// majorant in the weights. At a super-voxel border the rate starts again at the majorant of the cell
/// entered: so the weights telescope in each cell, to
///   (1 - mu(x_k) / majorant) exp(-sum of mu(x_i) (x_{i+1} - x_i)), x_{k+1} the exit, 1 without a collision,
/// which is in [0, 1], and no weight is divided by a rate that may be tiny.
///
/// Deviations: densities above the bound are not clamped to it, the weights take the sign of majorant - mu
/// instead, so the estimate stays unbiased. Channels: the rate is the largest |majorant - mu_c| of those with
/// extinction, under a bound that of the smallest; then every channel's weight telescopes likewise.
///
/// Bias: none, wherever the bounds are positive. Range: [0, 1] while bounds hold. Variance: at most T - T^2;
/// mostly below ratio tracking, but up to 1.5 times its where a short dense part comes before a thin one.
/// Cost: at most the optical depth of the majorant while bounds hold.
struct AdaptiveRatioTracking {
  static constexpr std::string_view kName = "adaptive-ratio";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &AdaptiveRatioTracking::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "ratio tracking whose rate follows the null extinction last seen",
            .source = "Misso et al. 2023, algorithm 2",
            .useWhen = "bounds are loose over long stretches and the density changes slowly",
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
    std::array<RunningProduct, N> weight;
    double exponent = 0;  // of the common factor
    bool isZero = false;
    // No PoissonWalk: the rate changes at every point, and the steps between points are weights.
    double depth = stream.exponential();
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      const double upper = bound.upper, majorant = sigmaMax * upper;
      if (!(upper > 0)) {
        probeTrusted(line, sEnter, sExit, 0, stream.rng(), tally);
        return true;
      }
      Rate rate;
      bool goesOn = true;
      for (double s = sEnter; !isZero;) {
        const double perLength = majorant * rate.share, depthToExit = (sExit - s) * perLength;
        if (depth >= depthToExit) {
          depth -= depthToExit;
          exponent += majorant * rate.beyond * (sExit - s);
          break;
        }
        goesOn = !limit.reached(tally);
        if (!goesOn) break;
        const double step = depth / perLength;
        s += step;
        exponent += majorant * rate.beyond * step;
        const double ratio = boundedLookup(line, s, upper, tally) / upper;
        ++tally.nullCollisions;
        rate = Rate();
        rate.share = 0;
        for (std::size_t c = 0; c < N; ++c) {
          if (sigmaT[c] > 0) rate.admit(share[c] * ratio);
        }
        // Once the weights are below every double and no bound was seen broken, nothing can come of them.
        isZero = rate.share == 0 || (exponent < -kOpaque && tally.violations == 0);
        for (std::size_t c = 0; c < N && !isZero; ++c) {
          weight[c].multiply((1 - share[c] * ratio) / rate.share);
        }
        depth = stream.exponential();
      }
      for (RunningProduct& w : weight) w.multiply(rate.share);
      return goesOn && !isZero;
    });
    for (std::size_t c = 0; c < N; ++c) {
      if (!(sigmaT[c] > 0)) continue;
      estimate.value[c] = isZero || weight[c].isZero() ? 0 : weight[c].timesExp(exponent);
    }
    return estimate;
  }

 private:
  /// exp(-x) is 0 in double beyond this.
  static constexpr double kOpaque = 746;

  /// The present rate, as a share of the majorant.
  struct Rate {
    double share = 1;   ///< largest |1 - mu_c / majorant|
    double beyond = 0;  ///< share - 1, without cancellation

    void admit(double ratio) {  // ratio: mu_c / majorant
      const double null = std::abs(1 - ratio);
      if (null < share) return;
      share = null;
      beyond = ratio <= 1 ? -ratio : ratio - 2;
    }
  };
};

}  // namespace pbrtmedia
