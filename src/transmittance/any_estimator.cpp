// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/any_estimator.h"

#include "transmittance/variant_names.h"

namespace pbrtmedia {

std::string_view nameOf(const AnyEstimator& estimator) { return alternativeName(estimator); }
std::optional<AnyEstimator> findEstimator(std::string_view name) {
  return findAlternative<AnyEstimator>(name);
}
std::vector<std::string_view> estimatorNames() { return alternativeNames<AnyEstimator>(); }

EstimatorTraits traitsOf(const AnyEstimator& estimator) {
  return std::visit([](const auto& held) { return held.traits(); }, estimator);
}
std::vector<ParameterDescription> parametersOf(const AnyEstimator& estimator) {
  return std::visit([](const auto& held) { return describeParameters(held); }, estimator);
}
AssignResult setParameter(AnyEstimator& estimator, std::string_view name, const ParameterValue& value) {
  return std::visit([&](auto& held) { return assignParameter(held, name, value); }, estimator);
}

AnyLaw lawOf(const AnyEstimator& estimator) {
  return std::visit(
      [](const auto& held) -> AnyLaw {
        if constexpr (requires { held.law; }) {
          return held.law;
        } else {
          return ExponentialLaw{};
        }
      },
      estimator);
}

bool setLaw(AnyEstimator& estimator, const AnyLaw& law) {
  return std::visit(
      [&](auto& held) {
        if (!held.traits().laws.has(law)) return false;
        if constexpr (requires { held.law = law; }) {
          held.law = law;
        } else if constexpr (requires { held.law = PinkNoiseLaw{}; }) {
          held.law = std::get<PinkNoiseLaw>(law);
        }
        return true;
      },
      estimator);
}

}  // namespace pbrtmedia
