// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/law.h"

#include "base/variant_names.h"

namespace pbrtmedia {

static_assert(std::is_same_v<std::variant_alternative_t<0, AnyLaw>, ExponentialLaw>);
static_assert(std::is_same_v<std::variant_alternative_t<1, AnyLaw>, PinkNoiseLaw>);
static_assert(std::is_same_v<std::variant_alternative_t<3, AnyLaw>, LinearLaw>);

std::string_view nameOf(const AnyLaw& law) { return alternativeName(law); }
std::optional<AnyLaw> findLaw(std::string_view name) { return findAlternative<AnyLaw>(name); }
std::vector<std::string_view> lawNames() { return alternativeNames<AnyLaw>(); }

std::vector<ParameterDescription> parametersOf(const AnyLaw& law) {
  return std::visit([](const auto& held) { return describeParameters(held); }, law);
}
AssignResult setParameter(AnyLaw& law, std::string_view name, const ParameterValue& value) {
  return std::visit([&](auto& held) { return assignParameter(held, name, value); }, law);
}

std::vector<std::string_view> LawSet::names() const {
  std::vector<std::string_view> all = lawNames(), served;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (bits_ >> i & 1u) served.push_back(all[i]);
  }
  return served;
}

}  // namespace pbrtmedia
