// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/parameters.h"
#include "transmittance/laws/davis_law.h"
#include "transmittance/laws/exponential_law.h"
#include "transmittance/laws/linear_law.h"
#include "transmittance/laws/mixture_law.h"
#include "transmittance/laws/pink_noise_law.h"

namespace pbrtmedia {

/// The one list of laws; the first is the default. A law g turns optical depth F >= 0 into transmittance:
/// g(0) = 1, falling, g >= 0. Each is a small value with `kName`, `kFormula`, g as its call operator,
/// parameters(), and for free flights
///   density(F): -g'(F), the density of the optical depth at which a flight collides; infinite F: 0
///   depthReached(u): the F at which g falls to u, infinite where it never does; u in (0, 1].
using AnyLaw = std::variant<ExponentialLaw, PinkNoiseLaw, DavisLaw, LinearLaw, MixtureLaw>;

/// g(F). F below 0, which only corrected quadrature can find, counts as 0 except for the exponential law.
inline double transmittanceOf(const AnyLaw& law, double depth) {
  if (const auto* exponential = std::get_if<ExponentialLaw>(&law)) return (*exponential)(depth);
  return std::visit([&](const auto& g) { return g(std::max(depth, 0.0)); }, law);
}

/// -g'(F), F >= 0.
inline double collisionDensityOf(const AnyLaw& law, double depth) {
  return std::visit([&](const auto& g) { return g.density(depth); }, law);
}
/// The optical depth that a flight flies, for u uniform in (0, 1]: it gets beyond F with probability g(F).
inline double depthReachedOf(const AnyLaw& law, double u) {
  return std::visit([&](const auto& g) { return g.depthReached(u); }, law);
}

/// What estimators evaluate of a law: g itself, or the collisions -g'(F) as a share of those at F = 0.
enum class LawCurve { Transmittance, Collisions };

/// -g'(0): collisions per optical depth before anything is in the way.
inline double collisionsAtStart(const AnyLaw& law) { return collisionDensityOf(law, 0); }

/// The curve at F; it is 1 at 0. F below 0 as in transmittanceOf(). A law without collisions: 0 for them.
inline double valueOf(LawCurve curve, const AnyLaw& law, double depth) {
  if (curve == LawCurve::Transmittance) [[likely]]
    return transmittanceOf(law, depth);
  const double atStart = collisionsAtStart(law);
  return atStart > 0 ? collisionDensityOf(law, std::max(depth, 0.0)) / atStart : 0;
}

std::string_view nameOf(const AnyLaw& law);
std::optional<AnyLaw> findLaw(std::string_view name);
std::vector<std::string_view> lawNames();
std::vector<ParameterDescription> parametersOf(const AnyLaw& law);
AssignResult setParameter(AnyLaw& law, std::string_view name, const ParameterValue& value);

/// The laws that an estimator serves, a bit for each alternative of AnyLaw.
class LawSet {
 public:
  static constexpr LawSet all() { return LawSet((1u << std::variant_size_v<AnyLaw>)-1); }
  static constexpr LawSet exponential() { return LawSet(1u); }
  static constexpr LawSet pinkNoise() { return LawSet(2u); }
  /// Those that are means of exponential laws over a random factor on the depth (MixedPoissonProcess).
  static constexpr LawSet mixtures() { return LawSet(all().bits_ & ~8u); }

  constexpr bool has(const AnyLaw& law) const { return (bits_ >> law.index() & 1u) != 0; }
  constexpr bool operator==(const LawSet&) const = default;
  std::vector<std::string_view> names() const;

 private:
  constexpr explicit LawSet(unsigned bits) : bits_(bits) {}
  unsigned bits_;
};

}  // namespace pbrtmedia
