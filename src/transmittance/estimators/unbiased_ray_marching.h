// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "transmittance/parts/series_march.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Unbiased ray marching: 1/(N+1) sum_i e^{X_i} sum_{k <= N} m_k({X_j - X_i}, j != i) / (k! P_k), where X_i
/// are N + 1 combs' estimates of minus the optical depth, m_k elementary symmetric means, and N = 0 with
/// probability 0.9, so that mostly one comb is all. Kettunen et al. 2021, algorithm 5; combs are warped by
/// super-voxel means (section 5) where these are known. Every choice of the paper is a parameter, for
/// ablations; without symmetrisation the first comb is the pivot and the products are plain. Roulette
/// "cumulative" goes by the values in their order and is never symmetrised.
///
/// Bias: none, whatever the bounds (roulette "none": the terms left out). Range: any number; do not clamp.
/// Variance: none in a constant medium, and none in a linear one with matched end points; falls faster than
/// 1 / cost for smooth densities, with bumps where the comb's spacing meets a frequency of the density. Cost:
/// on average that of p-series CMF (pSeriesCmfLookups of majorant minus minorant), plus two for end points;
/// so it grows with the control's optical depth, up to maxlookups a comb.
struct UnbiasedRayMarching {
  static constexpr std::string_view kName = "unbiased-ray-marching";

  Pivot pivot = Pivot::Sampled;
  double pivotDepth = 1;
  bool symmetrisation = true;
  ElementaryMeans elementaryMeans = ElementaryMeans::Exact;
  Comb comb = Comb::Equidistant;
  EndpointMatching endpointMatching = EndpointMatching::Auto;
  Roulette roulette = Roulette::Aggressive;
  double zeroOrderProbability = 0.9;
  double expansion = 2;
  std::uint64_t tupleSize = 0;
  Warp warp = Warp::Auto;
  std::uint64_t maxLookups = 0;  ///< of one comb, see LookupLimit

  static constexpr auto parameters() {
    using Self = UnbiasedRayMarching;
    return std::tuple{
        Parameter{"pivot", &Self::pivot, SeriesMarch::kPivotHelp},
        Parameter{"pivotdepth", &Self::pivotDepth, SeriesMarch::kPivotDepthHelp, 0, 1e6},
        Parameter{"symmetrisation", &Self::symmetrisation,
                  "average products over all choices of combs, and over the comb that is the pivot"},
        Parameter{"elementarymeans", &Self::elementaryMeans, SeriesMarch::kMeansHelp},
        Parameter{"comb", &Self::comb, CombSettings::kCombHelp},
        Parameter{"endpointmatching", &Self::endpointMatching, CombSettings::kMatchingHelp},
        Parameter{"roulette", &Self::roulette, SeriesMarch::kRouletteHelp},
        Parameter{"zeroorderprobability", &Self::zeroOrderProbability, SeriesMarch::kZeroOrderHelp, 0,
                  0.9999},
        Parameter{"expansion", &Self::expansion, SeriesMarch::kExpansionHelp, 0, 1e6},
        Parameter{"tuplesize", &Self::tupleSize, SeriesMarch::kTupleSizeHelp, 0, 0x1p32},
        Parameter{"warp", &Self::warp, CombSettings::kWarpHelp},
        Parameter{"maxlookups", &Self::maxLookups, LookupLimit::kCombHelp, 0}};
  }
  EstimatorTraits traits() const {
    EstimatorTraits traits{
        .summary =
            "ray marching by combs with random offsets, its bias removed by rare terms of higher order",
        .source = "Kettunen et al. 2021, algorithm 5",
        .useWhen = "transmittance noise matters, and a dozen look-ups a ray are affordable",
        .mayLeaveUnitInterval = true,
        .control =
            pivot == Pivot::Majorant ? EstimatorTraits::Control::Any : EstimatorTraits::Control::CostOnly};
    if (roulette == Roulette::None) SeriesMarch::markTruncated(traits);
    if (symmetrisation && elementaryMeans == ElementaryMeans::Published) {
      traits.bias = EstimatorTraits::Bias::Biased;
      traits.biasNote =
          "the published means lack factors; of the order of the combs' variance, in rare terms";
    }
    return traits;
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    return SeriesMarch{.pivot = pivot,
                       .pivotDepth = pivotDepth,
                       .isSymmetrised = symmetrisation,
                       .means = elementaryMeans,
                       .roulette = roulette,
                       .zeroOrderProbability = zeroOrderProbability,
                       .expansion = expansion,
                       .comb = {comb, endpointMatching, warp},
                       .tupleSize = tupleSize,
                       .mostTeeth = maxLookups,
                       .checksBounds = pivot == Pivot::Majorant}(line, sigmaT, stream);
  }
};

}  // namespace pbrtmedia
