// SPDX-License-Identifier: BSD-2-Clause
#include "reciprocal/any_reciprocal.h"

#include "base/variant_names.h"

namespace pbrtmedia {

std::string_view nameOf(const AnyReciprocal& estimator) { return alternativeName(estimator); }
std::optional<AnyReciprocal> findReciprocal(std::string_view name) {
  return findAlternative<AnyReciprocal>(name);
}
std::vector<std::string_view> reciprocalNames() { return alternativeNames<AnyReciprocal>(); }
ReciprocalTraits traitsOf(const AnyReciprocal& estimator) {
  return std::visit([](const auto& held) { return held.traits(); }, estimator);
}
std::vector<ParameterDescription> parametersOf(const AnyReciprocal& estimator) {
  return std::visit([](const auto& held) { return describeParameters(held); }, estimator);
}
AssignResult setParameter(AnyReciprocal& estimator, std::string_view name, const ParameterValue& value) {
  return std::visit([&](auto& held) { return assignParameter(held, name, value); }, estimator);
}

}  // namespace pbrtmedia
