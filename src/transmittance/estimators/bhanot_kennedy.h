// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "transmittance/parts/series_march.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Bhanot-Kennedy: e^p sum_{k <= N} prod_{i <= k} Y_i / (k! P_k), where Y_i = -F_i - p for independent
/// estimates F_i of the optical depth and a pivot p; by default one look-up each and p = -(depth of the
/// majorant). Orders up to K = floor(c) are certain, then the series goes on with c / k. Bhanot & Kennedy
/// 1985; Kettunen et al. 2021, section 2.5.2. Roulette "cumulative" with this pivot is p-series cumulative of
/// Georgiev et al. 2019, "cmf" is p-series CMF.
///
/// c defaults to the depth of the control (majorant minus minorant), at least 1: with a majorant pivot the
/// terms are largest near that order, and a smaller c makes the variance explode.
///
/// Bias: none (roulette "none": the terms left out). Range: any number. Variance with a fixed pivot, m =
/// E[Y], s^2 = Var[Y], a_k = 1 / (k! P_k): e^{2p} sum_{j,k} a_j a_k P_max(j,k) (s^2 + m^2)^min(j,k) m^|j-k| -
/// T^2. Cost: N look-ups per tooth, E[N] about c + sqrt(c).
struct BhanotKennedy {
  static constexpr std::string_view kName = "bhanot-kennedy";

  Pivot pivot = Pivot::Majorant;
  double pivotDepth = 1;
  Roulette roulette = Roulette::BhanotKennedy;
  double zeroOrderProbability = 0.9;
  double expansion = 0;
  std::uint64_t tupleSize = 1;
  Comb comb = Comb::Equidistant;
  Warp warp = Warp::Auto;
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    using Self = BhanotKennedy;
    return std::tuple{Parameter{"pivot", &Self::pivot, SeriesMarch::kPivotHelp},
                      Parameter{"pivotdepth", &Self::pivotDepth, SeriesMarch::kPivotDepthHelp, 0, 1e6},
                      Parameter{"roulette", &Self::roulette, SeriesMarch::kRouletteHelp},
                      Parameter{"zeroorderprobability", &Self::zeroOrderProbability,
                                SeriesMarch::kZeroOrderHelp, 0, 0.9999},
                      Parameter{"expansion", &Self::expansion, SeriesMarch::kExpansionHelp, 0, 1e6},
                      Parameter{"tuplesize", &Self::tupleSize, SeriesMarch::kTupleSizeHelp, 0, 0x1p32},
                      Parameter{"comb", &Self::comb, CombSettings::kCombHelp},
                      Parameter{"warp", &Self::warp, CombSettings::kWarpHelp},
                      Parameter{"maxlookups", &Self::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    EstimatorTraits traits{
        .summary = "power series of exp, each factor an independent look-up, the number of terms by roulette",
        .source = "Bhanot & Kennedy 1985; Kettunen et al. 2021, 2.5.2",
        .useWhen = "the series is studied: u-bk and unbiased-ray-marching have less variance",
        .bias = LookupLimit::bias(maxLookups),
        .biasNote = LookupLimit::biasNote(maxLookups),
        .mayLeaveUnitInterval = true,
        .control =
            pivot == Pivot::Majorant ? EstimatorTraits::Control::Any : EstimatorTraits::Control::CostOnly,
        .boundedCost = maxLookups > 0};
    if (roulette == Roulette::None) SeriesMarch::markTruncated(traits);
    return traits;
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    return SeriesMarch{.pivot = pivot,
                       .pivotDepth = pivotDepth,
                       .isSymmetrised = false,
                       .roulette = roulette,
                       .zeroOrderProbability = zeroOrderProbability,
                       .expansion = expansion,
                       .comb = {comb, EndpointMatching::Off, warp},
                       .tupleSize = tupleSize,
                       .limit = LookupLimit(maxLookups),
                       .checksBounds = true}(line, sigmaT, stream);
  }
};

}  // namespace pbrtmedia
