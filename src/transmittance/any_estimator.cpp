// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/any_estimator.h"

#include <cmath>

#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

AnyEstimator holding(EstimatorVariant variant) {
  return AnyEstimator(std::make_shared<const AnyEstimator::Held>(AnyEstimator::Held{std::move(variant)}));
}

}  // namespace

AnyEstimator::AnyEstimator() : held_(std::make_shared<const Held>()) {}

std::string_view nameOf(const AnyEstimator& estimator) { return alternativeName(estimator.held().variant); }
std::optional<AnyEstimator> findEstimator(std::string_view name) {
  auto found = findAlternative<EstimatorVariant>(name);
  if (!found) return std::nullopt;
  return holding(*std::move(found));
}
std::vector<std::string_view> estimatorNames() { return alternativeNames<EstimatorVariant>(); }

EstimatorTraits traitsOf(const AnyEstimator& estimator) {
  return visitEstimator([](const auto& held) { return held.traits(); }, estimator);
}
std::vector<ParameterDescription> parametersOf(const AnyEstimator& estimator) {
  return visitEstimator([](const auto& held) { return describeParameters(held); }, estimator);
}
AssignResult setParameter(AnyEstimator& estimator, std::string_view name, const ParameterValue& value) {
  EstimatorVariant changed = estimator.held().variant;
  AssignResult result = std::visit([&](auto& held) { return assignParameter(held, name, value); }, changed);
  estimator = holding(std::move(changed));
  return result;
}

AnyLaw lawOf(const AnyEstimator& estimator) {
  return visitEstimator(
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
  EstimatorVariant changed = estimator.held().variant;
  const bool isServed = std::visit(
      [&](auto& held) {
        if (!held.traits().laws.has(law)) return false;
        if constexpr (requires { held.law = law; }) {
          held.law = law;
        } else if constexpr (requires { held.law = PinkNoiseLaw{}; }) {
          held.law = std::get<PinkNoiseLaw>(law);
        }
        return true;
      },
      changed);
  if (isServed) estimator = holding(std::move(changed));
  return isServed;
}

CollisionEstimator collisionEstimatorOf(const AnyEstimator& estimator) {
  EstimatorVariant changed = estimator.held().variant;
  const double depthScale = std::visit(
      [](auto& held) -> double {
        if constexpr (requires { held.curve; }) {
          held.curve = LawCurve::Collisions;
          if constexpr (requires { held.rate; }) {
            // The collisions of this law end in a jump, whose corrections fall as slowly as those of the cost
            // may rise at most.
            if (std::holds_alternative<LinearLaw>(held.law)) held.rate = TelescopingLevels::kLeastRate;
          }
        } else if constexpr (requires { held.law.correlation; }) {
          // -g'(F) = (1 + C^2 F)^(-1/C^2 - 1) is pink noise again, of C^2 / (1 + C^2) at (1 + C^2) F.
          const double c = held.law.correlation;
          held.law.correlation = c / std::sqrt(1 + c * c);
          return 1 + c * c;
        } else {
          static_assert(
              !requires { held.law; }, "an estimator of any law has a `curve`");
        }
        return 1;
      },
      changed);
  return {holding(std::move(changed)), depthScale};
}

}  // namespace pbrtmedia
