// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/law.h"
#include "transmittance/parts/comb_march.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Where in its step a ray marcher looks.
enum class StepOffset {
  Midpoint,  ///< the same at every estimate: error without noise
  Random     ///< one random place for all steps
};
template <>
inline constexpr std::array kChoices<StepOffset>{std::string_view("midpoint"), std::string_view("random")};

/// Ray marching as it always was: g(F), F the sum of the densities in the middle, or at one random place, of
/// equal steps no longer than `stepSize`. The baseline of Kettunen et al. 2021 and Misso et al. 2022.
///
/// Bias: midpoint, the quadrature's error, without any noise; random, g''(tau) Var[F] / 2, for the
/// exponential law T Var[F] / 2 upwards, and then none in the optical depth itself. Range: [0, 1]. Cost:
/// length / stepSize look-ups, less those in super-voxels proven empty; bounds are not needed.
struct RayMarching {
  static constexpr std::string_view kName = "ray-marching";

  double stepSize = 0;       ///< [length], >= 0; 0: by `steps`
  std::uint64_t steps = 32;  ///< of a line, where stepSize is 0
  StepOffset offset = StepOffset::Random;
  std::uint64_t maxLookups = 0;
  AnyLaw law = {};
  /// No parameter: collisionEstimatorOf().
  LawCurve curve = LawCurve::Transmittance;

  static constexpr auto parameters() {
    using Self = RayMarching;
    return std::tuple{
        Parameter{"stepsize", &Self::stepSize, "longest step, in units of the ray; 0: as many as steps says",
                  0},
        Parameter{"steps", &Self::steps, "steps through the medium where stepsize is 0", 1, 0x1p32},
        Parameter{"offset", &Self::offset, "where in a step to look: midpoint, or one random place for all"},
        Parameter{"maxlookups", &Self::maxLookups, CombMarch::kLimitHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "the law at the optical depth summed over equal steps",
            .source = "the classical baseline; Misso et al. 2022 (21)",
            .useWhen = "something to compare with is wanted, or bounds are not to be had",
            .bias = EstimatorTraits::Bias::Consistent,
            .biasNote = offset == StepOffset::Random
                            ? "T Var[F] / 2 upwards, F the sum; vanishes with the step"
                            : "the midpoint rule's error; vanishes with the step",
            .control = EstimatorTraits::Control::Unused,
            .boundedCost = !(stepSize > 0) || maxLookups > 0,
            .laws = LawSet::all()};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    const auto teethUnder = [&](double) {
      return stepSize > 0 ? std::ceil(line.length() / stepSize) : static_cast<double>(steps);
    };
    return CombMarch{{Comb::Equidistant, EndpointMatching::Off, Warp::Off}, maxLookups}(
        line, sigmaT, stream, teethUnder, [&](auto& combs) {
          const double column = combs.integralFrom(offset == StepOffset::Midpoint ? 0.5 : stream.uniform());
          Channels<N> value;
          for (std::size_t c = 0; c < N; ++c) value[c] = valueOf(curve, law, sigmaT[c] * column);
          return value;
        });
  }
};

}  // namespace pbrtmedia
