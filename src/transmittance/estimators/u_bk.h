// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "transmittance/parts/series_march.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// U-BK: Bhanot-Kennedy with every product of k of the N factors averaged over all choices of k of them (an
/// elementary symmetric mean, the U-statistic of the product), and with the pivot an estimate too, each of
/// the N + 1 in turn. Kettunen et al. 2021, section 4.1 and Eqs. (31), (32), with combs of the automatic size
/// of section 4.6; unbiased ray marching without its roulette and its end points.
///
/// Bias: none. Range: any number. Variance with a fixed pivot given N, m = E[Y], s^2 = Var[Y]:
/// E[m_j m_k] = sum_r C(j,r) C(N-j,k-r) / C(N,k) (s^2 + m^2)^r m^{j+k-2r}; never above Bhanot-Kennedy's.
/// Cost: N + 1 combs, E[N] = 3.19 for c = 2; with a fixed or majorant pivot N. Beyond some hundreds of terms
/// (sampled pivot; thousands otherwise) plain products are taken, as the means would cost minutes.
struct UBk {
  static constexpr std::string_view kName = "u-bk";

  Pivot pivot = Pivot::Sampled;
  double pivotDepth = 1;
  double expansion = 2;
  std::uint64_t tupleSize = 0;
  Comb comb = Comb::Equidistant;
  Warp warp = Warp::Auto;
  std::uint64_t maxLookups = 0;  ///< of one comb, see LookupLimit

  static constexpr auto parameters() {
    using Self = UBk;
    return std::tuple{Parameter{"pivot", &Self::pivot, SeriesMarch::kPivotHelp},
                      Parameter{"pivotdepth", &Self::pivotDepth, SeriesMarch::kPivotDepthHelp, 0, 1e6},
                      Parameter{"expansion", &Self::expansion, SeriesMarch::kExpansionHelp, 0, 1e6},
                      Parameter{"tuplesize", &Self::tupleSize, SeriesMarch::kTupleSizeHelp, 0, 0x1p32},
                      Parameter{"comb", &Self::comb, CombSettings::kCombHelp},
                      Parameter{"warp", &Self::warp, CombSettings::kWarpHelp},
                      Parameter{"maxlookups", &Self::maxLookups, LookupLimit::kCombHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "symmetrised power series of exp about a sampled pivot, its factors combs",
            .source = "Kettunen et al. 2021, 4.1",
            .useWhen = "little variance is wanted in every single estimate, whatever the mean cost",
            .mayLeaveUnitInterval = true,
            .control = pivot == Pivot::Majorant ? EstimatorTraits::Control::Any
                                                : EstimatorTraits::Control::CostOnly};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    return SeriesMarch{.pivot = pivot,
                       .pivotDepth = pivotDepth,
                       .isSymmetrised = true,
                       .roulette = Roulette::BhanotKennedy,
                       .expansion = expansion,
                       .comb = {comb, EndpointMatching::Off, warp},
                       .tupleSize = tupleSize,
                       .mostTeeth = maxLookups,
                       .checksBounds = pivot == Pivot::Majorant}(line, sigmaT, stream);
  }
};

}  // namespace pbrtmedia
