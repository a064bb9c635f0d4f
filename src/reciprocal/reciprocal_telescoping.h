// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/math.h"
#include "base/parameters.h"
#include "reciprocal/per_channel.h"
#include "reciprocal/reciprocal_function.h"
#include "reciprocal/reciprocal_traits.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/telescoped_march.h"
#include "transmittance/parts/vacuum.h"

namespace pbrtmedia {

/// Which corrections of a telescoping sum an estimate evaluates.
enum class Correction {
  Single,  ///< one random level, over its probability
  Prefix   ///< all up to a random level, each over the probability of getting there
};
template <>
inline constexpr std::array kChoices<Correction>{std::string_view("single"), std::string_view("prefix")};

/// 1/F as the reciprocal of a coarse march of the density, plus corrections by refinement (TelescopedMarch).
/// Misso et al. 2022, doi:10.1145/3528223.3530160, Eqs. (12), (14), (15); McLeish 2011.
///
/// Bias: none on densities above 0. One that is 0 somewhere lets coarse marches find nothing: their
/// reciprocals are infinite, and so is the estimate. Variance: finite on densities bounded away from 0 where
/// that of debiased ray marching is. Cost: n 2^k 2 r / (2 r - 1) look-ups on average, n 2^k more without
/// reuse, whatever F; its variance is infinite for r <= 3/4. No control is used, but its being 0 tells that
/// there is nothing.
struct ReciprocalTelescoping {
  static constexpr std::string_view kName = "reciprocal-telescoping";

  std::uint64_t n = 1;
  std::uint64_t levels = 2;
  double rate = TelescopingLevels::kRate;
  Comb comb = Comb::Equidistant;
  Correction correction = Correction::Single;
  bool reuse = true;
  std::uint64_t maxLookups = 0;

  static constexpr auto parameters() {
    using Self = ReciprocalTelescoping;
    return std::tuple_cat(
        TelescopedMarch::marchParameters<Self>(),
        std::tuple{Parameter{"correction", &Self::correction,
                             "one random level (single), or all up to a random level (prefix)"}},
        TelescopedMarch::costParameters<Self>());
  }
  ReciprocalTraits traits() const {
    return {.summary = "the reciprocal of a coarse march, plus random corrections by refinement",
            .source = "Misso et al. 2022 (12), (14), (15); McLeish 2011",
            .useWhen = "the density is smooth and nowhere near 0, and no bound is known",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .domain = "densities above 0 everywhere",
            .control = EstimatorTraits::Control::Unused,
            .needsPositiveDensity = true,
            .finiteVariance = TelescopingLevels::hasFiniteVariance(comb, rate, ExponentialLaw{}),
            .varianceNote = "on densities bounded away from 0",
            .cost = reuse ? "n 2^levels 2 r / (2 r - 1)" : "n 2^levels (1 + 2 r / (2 r - 1))",
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate{.value = filled<N>(kInfinity), .tally = {}};
    if (isVacuum(line, stream.rng(), estimate.tally)) return estimate;
    double sum = 0;
    bool foundNothing = false;
    const auto add = [&](double integral, double factor) {
      if (integral > 0) {
        sum += factor * ReciprocalFunction{}(integral);
      } else {
        foundNothing = true;
      }
    };
    const TelescopedMarch march{n, levels, rate, comb, reuse, maxLookups};
    if (correction == Correction::Single) {
      march.single(line, stream, estimate.tally, add);
    } else {
      march.prefix(line, stream, estimate.tally, add);
    }
    estimate.value = reciprocalPerChannel(sigmaT, foundNothing ? kInfinity : sum);
    return estimate;
  }
};

}  // namespace pbrtmedia
