// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>

#include "base/geometric_levels.h"
#include "transmittance/law.h"
#include "transmittance/parts/comb.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// The levels of a march that is refined by halving its step: level i has teeth * 2^i look-ups, and its
/// correction Delta_i = g(march of level i + 1) - g(march of level i) costs teeth * 2^(i+1). The level to
/// correct is geometric (GeometricLevels). Misso et al. 2022, Eqs. (12), (22); Blanchet & Glynn 2015.
///
/// Levels end where a correction would need more than 2^30 look-ups. The bias of leaving out the rest is that
/// of a march of 2^30 teeth, below the rounding of a density, and Pr of ever getting there is (1 -
/// rate)^28 with four teeth: 2e-13 at rate 0.65, 2e-9 at 0.51.
class TelescopingLevels {
 public:
  static constexpr std::uint64_t kMostLookups = std::uint64_t{1} << 30;
  /// Above 1/2 the expected number of look-ups is finite.
  static constexpr double kLeastRate = 0.501, kLargestRate = 0.999;
  /// Misso et al. 2022; optimal where Var[Delta_i] falls like 4^-i, that is for independent look-ups.
  static constexpr double kRate = 0.65;
  static constexpr std::uint64_t kMostBaseTeeth = 4096, kMostBaseLevel = 16;

  static constexpr std::string_view kCountHelp = "look-ups of a march of level 0";
  static constexpr std::string_view kBaseHelp =
      "level that every estimate evaluates; each level doubles the look-ups";
  static constexpr std::string_view kRateHelp =
      "the corrected level is geometric with this probability of the lowest; expected look-ups grow like 1 / "
      "(2 rate - 1), and from 3/4 on their variance is finite";
  static constexpr std::string_view kLimitHelp =
      "most look-ups of one estimate, 0: no limit; corrections that need more are left out, biased, and are "
      "counted";

  /// `teeth` >= 1 of the lowest level, `mostLookups` in all (0: kMostLookups) of which `apart` are spent
  /// elsewhere.
  TelescopingLevels(std::uint64_t teeth, double rate, std::uint64_t mostLookups, std::uint64_t apart)
      : geometric_(rate) {
    const std::uint64_t most = mostLookups > 0 ? std::min(mostLookups, kMostLookups) : kMostLookups;
    const std::uint64_t corrections = (most > apart ? most - apart : 0) / teeth;
    levels_ = static_cast<unsigned>(std::bit_width(corrections | 1)) - 1;  // 2^levels <= corrections
  }

  /// Levels that can be corrected: 0 .. count() - 1.
  unsigned count() const { return levels_; }
  /// From u in (0, 1]; may be count() or more, where there is nothing to correct.
  unsigned draw(double u) const { return geometric_.draw(u); }  // at most 37 / 0.69
  /// Pr{level >= i}.
  double reaching(unsigned i) const { return geometric_.reaching(i); }
  double probability(unsigned i) const { return geometric_.probability(i); }

  /// Teeth of the coarse march: n 2^levels, or what the limit leaves.
  static std::uint64_t baseTeeth(std::uint64_t n, std::uint64_t levels, std::uint64_t mostLookups) {
    const std::uint64_t teeth = n << levels;
    return mostLookups > 0 ? std::min(teeth, mostLookups) : teeth;
  }
  /// What every estimator that telescopes promises; summary, source and use are its own.
  static EstimatorTraits traits(Comb comb, double rate, const AnyLaw& law, std::uint64_t mostLookups) {
    EstimatorTraits traits;
    traits.bias = LookupLimit::bias(mostLookups);
    traits.biasNote = LookupLimit::biasNote(mostLookups);
    traits.mayLeaveUnitInterval = true;
    traits.control = EstimatorTraits::Control::Unused;
    traits.finiteVariance = traits.finiteVarianceUnbounded = hasFiniteVariance(comb, rate, law);
    traits.boundedCost = mostLookups > 0;
    traits.laws = LawSet::all();
    return traits;
  }

  /// Whether sum_i E[Delta_i^2] / Pr is finite on every bounded density of bounded variation. The
  /// difference of the two halves of level i + 1 is of order 2^-i for combs and 2^(-i/2) for independent
  /// look-ups; Delta_i is its square, or under a law with a kink the difference itself.
  static bool hasFiniteVariance(Comb comb, double rate, const AnyLaw& law) {
    const double difference = comb == Comb::Independent ? 0.5 : 0.25;  // decay of its square per level
    return std::holds_alternative<LinearLaw>(law) ? difference < 1 - rate
                                                  : difference * difference < 1 - rate;
  }

 private:
  GeometricLevels geometric_;
  unsigned levels_;
};

}  // namespace pbrtmedia
