// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/law.h"
#include "transmittance/parts/comb.h"
#include "transmittance/parts/telescoped_march.h"
#include "transmittance/parts/telescoping_levels.h"
#include "transmittance/parts/vacuum.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Debiased ray marching: g at the optical depth of a coarse march, plus one correction from a random level
/// of refinement, I(k) + Delta_j / p(j), with
///   Delta_j = g(F) - (g(F_1) + g(F_2)) / 2,  F = (F_1 + F_2) / 2,
/// F_1 and F_2 the marches of level j that one march of level j + 1 splits into (NestedMarch). Misso et al.
/// 2022, doi:10.1145/3528223.3530160, Eqs. (14), (22). Serves every law, as g is only evaluated. The level is
/// the same for all channels, which share the marches. Unlike the paper the coarse estimate may be read off
/// the march of the correction, as the mean of g over all its parts of level k.
///
/// Bias: none (TelescopingLevels on its end; maxlookups). Range: any. Variance: that of the coarse march plus
/// sum_j E[Delta_j^2] / p(j) - (sum Delta_j)^2 without reuse; E[Delta_j^2] falls like 4^-j for independent
/// look-ups, like 16^-j or faster for combs; see TelescopingLevels::hasFiniteVariance. Cost: n 2^k (1 + 2 r /
/// (2 r - 1)) look-ups on average, without the 1 under reuse, whatever the optical depth; its variance is
/// infinite for r <= 3/4. Bounds only tell vacuum, which costs none.
struct DebiasedRayMarching {
  static constexpr std::string_view kName = "debiased-ray-marching";

  AnyLaw law = {};
  /// No parameter: collisionEstimatorOf().
  LawCurve curve = LawCurve::Transmittance;
  std::uint64_t n = 1;                     ///< look-ups at level 0
  std::uint64_t levels = 2;                ///< k, the level of the coarse march
  double rate = TelescopingLevels::kRate;  ///< r
  Comb comb = Comb::Equidistant;
  bool reuse = true;  ///< the coarse march is part of that of the correction
  std::uint64_t maxLookups = 0;

  static constexpr auto parameters() {
    using Self = DebiasedRayMarching;
    return std::tuple_cat(TelescopedMarch::marchParameters<Self>(), TelescopedMarch::costParameters<Self>());
  }
  EstimatorTraits traits() const {
    EstimatorTraits traits = TelescopingLevels::traits(comb, rate, law, maxLookups);
    traits.summary = "the law at a coarse march, plus one random level of the corrections by refinement";
    traits.source = "Misso et al. 2022 (14), (22); Blanchet & Glynn 2015";
    traits.useWhen = "the law is not exponential, or the medium is thin or smooth; bounds are not needed";
    return traits;
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    if (!(maxOf(sigmaT) > 0) || isVacuum(line, stream.rng(), estimate.tally)) return estimate;
    estimate.value = filled<N>(0);
    const TelescopedMarch march{n, levels, rate, comb, reuse, maxLookups};
    march.single(line, stream, estimate.tally, [&](double column, double factor) {
      for (std::size_t c = 0; c < N; ++c) {
        estimate.value[c] += factor * valueOf(curve, law, sigmaT[c] * column);
      }
    });
    return estimate;
  }
};

}  // namespace pbrtmedia
