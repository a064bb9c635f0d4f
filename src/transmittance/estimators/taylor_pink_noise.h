// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/law.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/comb.h"
#include "transmittance/parts/comb_integrator.h"
#include "transmittance/parts/comb_size.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/series_march.h"
#include "transmittance/parts/taylor_roulette.h"
#include "transmittance/parts/vacuum.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Pink-noise transmittance as a Taylor series about a pivot alpha, with marches of a fixed step as estimates
/// F_i of the optical depth:
///   Delta_j = (alpha - F)^j / j! (1 + alpha C^2)^(-1/C^2 - j) prod_{i < j} (1 + i C^2),
/// the first three terms always, the rest with probability 0.1 and then by roulette (TaylorRoulette). Misso
/// et al. 2022, doi:10.1145/3528223.3530160, Eqs. (25), (26). Powers are elementary symmetric means of the
/// marches, and a sampled pivot is each march in turn (Kettunen et al. 2021), as the paper suggests and
/// leaves open; without symmetrisation they are plain products about the first march. Marches are jittered,
/// one point in each step. The marches serve all channels.
///
/// Bias: none as long as E|alpha - F_i| < alpha + 1/C^2, for each pivot that occurs; so always where F_i < 2
/// alpha + 1/C^2, for example with the pivot at a constant majorant. Beyond, the sum has no mean. Variance:
/// finite if E[(alpha - F_i)^2] < (1/C + alpha C)^2 for each pivot, C < 1; marches finer than the features of
/// the density make both true for pivots near the depth. Range: any. Cost: terms - 1 marches, one more with a
/// sampled pivot, and the rare further ones; length / step look-ups each.
struct TaylorPinkNoise {
  static constexpr std::string_view kName = "taylor-pink-noise";

  PinkNoiseLaw law = {};
  double stepSize = 0.2;  ///< unit of t
  Comb comb = Comb::Stratified;
  Warp warp = Warp::Off;
  Pivot pivot = Pivot::Sampled;
  double pivotDepth = 1;    ///< of the largest channel, for Pivot::Fixed
  std::uint64_t terms = 3;  ///< k: orders below it are certain
  double correctionProbability = 0.1;
  bool symmetrisation = true;
  std::uint64_t maxLookups = 0;  ///< of one march, see LookupLimit

  static constexpr auto parameters() {
    using Self = TaylorPinkNoise;
    return std::tuple{
        Parameter{"stepsize", &Self::stepSize, "length of a step of the march, one look-up each", 1e-9, 1e9},
        Parameter{"comb", &Self::comb, CombSettings::kCombHelp},
        Parameter{"warp", &Self::warp, CombSettings::kWarpHelp},
        Parameter{"pivot", &Self::pivot, SeriesMarch::kPivotHelp},
        Parameter{"pivotdepth", &Self::pivotDepth, SeriesMarch::kPivotDepthHelp, 0, 1e6},
        Parameter{"terms", &Self::terms, "terms of the series that every estimate evaluates", 1,
                  TaylorRoulette::kMostTerms},
        Parameter{"correctionprobability", &Self::correctionProbability,
                  "probability of going on beyond these terms", 1e-3, 1},
        Parameter{"symmetrisation", &Self::symmetrisation, TaylorRoulette::kSymmetrisationHelp},
        Parameter{"maxlookups", &Self::maxLookups, LookupLimit::kCombHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "the Taylor series of pink noise about a march, its factors marches",
            .source = "Misso et al. 2022 (25), (26)",
            .useWhen = "the law is pink noise with C < 1 and steps are finer than the medium's features",
            .biasNote =
                "none where marches F_i err by E|alpha - F_i| < alpha + 1/C^2 about the pivot alpha; "
                "no mean beyond",
            .mayLeaveUnitInterval = true,
            .control =
                pivot == Pivot::Majorant ? EstimatorTraits::Control::Any : EstimatorTraits::Control::Unused,
            .finiteVariance = false,
            .finiteVarianceUnbounded = false,
            .boundedCost = false,
            .laws = LawSet::pinkNoise()};
  }
  TaylorRoulette roulette() const { return {law, terms, correctionProbability, symmetrisation}; }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0) || isVacuum(line, stream.rng(), estimate.tally)) return estimate;
    const BoundProfile profile(line);
    const std::uint64_t teeth = teethOf(std::ceil(profile.length() / stepSize), mostTeeth());
    CombIntegrator<Line> march(line, profile, {comb, EndpointMatching::Off, warp}, teeth,
                               pivot == Pivot::Majorant, stream, estimate.tally);
    const TaylorRoulette orders = roulette();
    const auto order = static_cast<std::size_t>(orders.draw(stream.uniformAboveZero()));

    const bool sampled = pivot == Pivot::Sampled;
    alignas(double) std::array<std::byte, 32 * sizeof(double)> buffer;
    std::pmr::monotonic_buffer_resource memory(buffer.data(), buffer.size());
    std::pmr::vector<double> columns(order + (sampled ? 1 : 0), &memory);
    for (double& column : columns) column = march.integral();
    if (sampled) {
      orders.sumAboutEach(columns, sigmaT, estimate.value);
    } else {
      const double given = pivot == Pivot::Majorant ? profile.upper() : pivotDepth / sigmaMax;
      orders.sumAbout(given, columns, sigmaT, estimate.value);
    }
    return estimate;
  }

 private:
  /// A march of more steps would take minutes: beyond, steps are longer, which is no bias.
  static constexpr std::uint64_t kMostTeeth = std::uint64_t{1} << 24;
  std::uint64_t mostTeeth() const { return maxLookups > 0 ? std::min(maxLookups, kMostTeeth) : kMostTeeth; }
};

}  // namespace pbrtmedia
