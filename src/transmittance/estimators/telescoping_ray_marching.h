// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/law.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/comb.h"
#include "transmittance/parts/comb_integrator.h"
#include "transmittance/parts/comb_size.h"
#include "transmittance/parts/telescoping_levels.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Telescoping ray marching: the law g at one comb of n equidistant teeth, and with probability q only one
/// correction, at a geometric level J:
///   g(F_0) + 1{corrected} Delta_J / (q r (1 - r)^J),  Delta_j = g(F_{j+1}) - (g(F_j) + g(F'_j)) / 2,
/// where F_j is the optical depth of a comb of n 2^j teeth, F'_j that of the comb halfway between its teeth,
/// and F_{j+1} = (F_j + F'_j) / 2 the comb of both: combs are nested, so that level J needs the teeth of the
/// lower ones and n (2^(J+1) - 1) of its own. It does for the telescoping sum (Misso et al. 2022, Eq. (14))
/// what rare higher orders do for the power series in unbiased ray marching, but one comb nearly as large as
/// the whole cost is order zero, and a correction is a curvature, of the order of the comb's variance. Serves
/// every law; all channels share the combs.
///
/// Bias: none, whatever the bounds (TelescopingLevels on its end; maxlookups): with a uniform offset
/// E[g(F_j)] = E[g(F'_j)] is the mean of a comb of its size, and these tend to T. Range: any number; do not
/// clamp. Variance: E[g(F_0)^2 + 2 g(F_0) sum_j Delta_j + sum_j Delta_j^2 / (q r (1 - r)^j)] - T^2 over the
/// offset, that of one comb plus a share of fourth order; none in a constant medium, and none in a linear one
/// with matched ends. Cost: n (1 + q / (2 r - 1)) on average, two more for matched ends, of finite variance
/// for r > 3/4; nothing where the bounds are proven and leave no excess, as these say what the integral is.
///
/// Of little use where the comb resolves nothing: under depths far above the teeth, single features thinner
/// than their spacing make rare large corrections, as they do for every estimator of combs; and a comb whose
/// spacing meets a frequency of the density (n or a multiple of it) loses to any other number of teeth.
struct TelescopingRayMarching {
  static constexpr std::string_view kName = "telescoping-ray-marching";
  /// Corrections are as frequent as the comb may be wrong: q is this times the control's depth between two
  /// teeth, within limits. Over eighteen functions .1 and .2 cost the same, and .05 has the longer tails.
  static constexpr double kCaution = 0.2;
  static constexpr double kLeastProbability = 0.01, kLargestProbability = 0.5;
  /// Where bounds are not known to be true they may say too little.
  static constexpr double kLeastProbabilityUnproven = 0.1;
  /// Above 3/4, for a cost of finite variance; .9 has a hundred times the kurtosis.
  static constexpr double kRate = 0.8;
  /// Teeth that are spent from this depth of the control on, and as a share of it below.
  static constexpr double kLeastTeeth = CombSettings::kLeastMatchedTeeth, kThin = 0.1;
  /// More are left to the corrections: a density that needs them is none.
  static constexpr std::uint64_t kMostTeeth = std::uint64_t{1} << 20;

  AnyLaw law = {};
  /// No parameter: collisionEstimatorOf().
  LawCurve curve = LawCurve::Transmittance;
  std::uint64_t tupleSize = 0;
  double tupleScale = 1.5;
  EndpointMatching endpointMatching = EndpointMatching::Auto;
  Warp warp = Warp::Auto;
  double correctionProbability = 0;  ///< q; 0: automatic
  double rate = kRate;               ///< r
  std::uint64_t maxLookups = 0;

  static constexpr auto parameters() {
    using Self = TelescopingRayMarching;
    using L = TelescopingLevels;
    return std::tuple{
        Parameter{"tuplesize", &Self::tupleSize,
                  "look-ups of the comb; 0: tuplescale times what p-series CMF spends on average, and where "
                  "the control is not thin at least that times 8",
                  0, kMostTeeth},
        Parameter{
            "tuplescale", &Self::tupleScale,
            "factor on the automatic number of look-ups; 1: the cost of p-series CMF where this is 10 or "
            "more; the variance falls faster than the cost grows",
            1e-3, 1e3},
        Parameter{"endpointmatching", &Self::endpointMatching, CombSettings::kMatchingHelp},
        Parameter{"warp", &Self::warp, CombSettings::kWarpHelp},
        Parameter{"correctionprobability", &Self::correctionProbability,
                  "how often a correction is made; 0: as often as the control's depth between two look-ups "
                  "asks for, a fifth of it",
                  0, 1},
        Parameter{"rate", &Self::rate, L::kRateHelp, L::kLeastRate, L::kLargestRate},
        Parameter{"maxlookups", &Self::maxLookups, L::kLimitHelp, 0}};
  }
  EstimatorTraits traits() const {
    EstimatorTraits traits = TelescopingLevels::traits(Comb::Equidistant, rate, law, maxLookups);
    traits.summary = "the law at one comb, plus a rare correction from a random level of its refinement";
    traits.source =
        "ours; telescoping as in Misso et al. 2022 (14), rare corrections and matched ends as in Kettunen et "
        "al. 2021";
    traits.useWhen =
        "transmittance noise matters, and a dozen look-ups a ray are affordable; the law need not be "
        "exponential";
    traits.control = EstimatorTraits::Control::CostOnly;
    return traits;
  }

  /// n, under a control (majorant minus minorant) of this optical depth in the largest channel.
  std::uint64_t teethFor(double control) const {
    constexpr double kEnds = 2;
    const double wanted =
        tupleSize > 0 ? static_cast<double>(tupleSize)
                      : tupleScale * std::max(pSeriesCmfLookups(control) - kEnds,
                                              std::ceil(kLeastTeeth * std::min(control / kThin, 1.0)));
    return std::min(teethOf(wanted, maxLookups), kMostTeeth);
  }
  /// q.
  double probabilityFor(double control, std::uint64_t teeth, bool isProven) const {
    if (correctionProbability > 0) return correctionProbability;
    return std::clamp(kCaution * control / static_cast<double>(teeth),
                      isProven ? kLeastProbability : kLeastProbabilityUnproven, kLargestProbability);
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return estimate;
    const BoundProfile profile(line);
    const bool isProven = line.hasProvenBounds();
    if (!(profile.length() > 0)) return estimate;
    const auto add = [&](double column, double factor) {
      for (std::size_t c = 0; c < N; ++c) {
        estimate.value[c] += factor * valueOf(curve, law, sigmaT[c] * column);
      }
    };
    estimate.value = filled<N>(0);
    if (isProven && !(profile.excess() > 0)) {
      add(profile.upper(), 1);
      return estimate;
    }
    // Beyond kOpaque nothing distinguishes controls any more, but infinity would not be a number of teeth.
    constexpr double kOpaque = 1e15;
    const double control = std::min(sigmaMax * profile.excess(), kOpaque);
    const std::uint64_t teeth = teethFor(control);
    const CombSettings settings{Comb::Equidistant, endpointMatching, warp};
    CombIntegrator<Line> combs(line, profile, settings, teeth, !isProven, stream, estimate.tally);
    double offset = stream.uniform();
    double column = combs.integralFrom(offset);
    add(column, 1);

    const double q = probabilityFor(control, teeth, isProven), u = stream.uniformAboveZero();
    if (u > q) return estimate;
    const TelescopingLevels levels(teeth, rate, maxLookups, settings.matches(teeth) ? 2 : 0);
    const unsigned level = levels.draw(u / q);
    if (level >= levels.count()) {
      estimate.tally.capped = 1;
      return estimate;
    }
    for (unsigned i = 0;; ++i) {
      const double between = combs.integralFrom(offset < 0.5 ? offset + 0.5 : offset - 0.5);
      const double both = (column + between) / 2;
      if (i == level) {
        addCorrection(column, between, 1 / (q * levels.probability(level)), add);
        return estimate;
      }
      column = both;
      offset = 2 * offset - (offset < 0.5 ? 0 : 1);
      combs.doubleTeeth();
    }
  }

 private:
  /// Combs that differ by rounding alone are equal: divided by the probability of a high level, what their
  /// difference leaves of g would be noise.
  template <class Add>
  static void addCorrection(double column, double between, double weight, const Add& add) {
    constexpr double kRounding = 0x1p-46;
    const double both = (column + between) / 2;
    if (!(std::abs(column - between) > kRounding * std::abs(both))) return;
    add(both, weight);
    add(column, -weight / 2);
    add(between, -weight / 2);
  }
};

}  // namespace pbrtmedia
