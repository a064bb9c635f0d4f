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

/// Debiased ray marching as a prefix sum: g at the optical depth of a coarse march, plus all corrections up
/// to a random level j, each divided by the probability of getting there,
///   I(k) + sum_{i=k}^{j} (A_{i+1} - A_i) / Pr{J >= i}.
/// Misso et al. 2022, doi:10.1145/3528223.3530160, Eqs. (15), (22). One march of level j + 1 serves all
/// terms: A_i is the mean of g over its parts of level i (NestedMarch), and I(k) = A_k, or under `reuse`
/// false a march of its own (TelescopedMarch). Serves every law; the level is the same for all channels.
///
/// Bias: none (TelescopingLevels on its end; maxlookups). Range: any. Variance: finite where that of the
/// single-term form is (DebiasedRayMarching), and of the same size: terms are divided by larger
/// probabilities, but several of them come together. Cost: n 2^k 2 r / (2 r - 1) look-ups on average,
/// n 2^k more without reuse, whatever the optical depth; its variance is infinite for r <= 3/4. g is
/// evaluated twice per coarse march. Bounds only tell vacuum, which costs none.
struct PrefixDebiasedRayMarching {
  static constexpr std::string_view kName = "prefix-debiased-ray-marching";

  AnyLaw law = {};
  /// No parameter: collisionEstimatorOf().
  LawCurve curve = LawCurve::Transmittance;
  std::uint64_t n = 1;       ///< look-ups at level 0
  std::uint64_t levels = 2;  ///< k, the level of the coarse march
  double rate = TelescopingLevels::kRate;
  Comb comb = Comb::Equidistant;
  bool reuse = true;  ///< the coarse march is part of that of the corrections
  std::uint64_t maxLookups = 0;

  static constexpr auto parameters() {
    using Self = PrefixDebiasedRayMarching;
    return std::tuple_cat(TelescopedMarch::marchParameters<Self>(), TelescopedMarch::costParameters<Self>());
  }
  EstimatorTraits traits() const {
    EstimatorTraits traits = TelescopingLevels::traits(comb, rate, law, maxLookups);
    traits.summary = "the law at a coarse march, plus all corrections by refinement up to a random level";
    traits.source = "Misso et al. 2022 (15), (22)";
    traits.useWhen = "as debiased-ray-marching, where corrections of several levels matter";
    return traits;
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    if (!(maxOf(sigmaT) > 0) || isVacuum(line, stream.rng(), estimate.tally)) return estimate;
    estimate.value = filled<N>(0);
    const TelescopedMarch march{n, levels, rate, comb, reuse, maxLookups};
    march.prefix(line, stream, estimate.tally, [&](double column, double factor) {
      for (std::size_t c = 0; c < N; ++c) {
        estimate.value[c] += factor * valueOf(curve, law, sigmaT[c] * column);
      }
    });
    return estimate;
  }
};

}  // namespace pbrtmedia
