// SPDX-License-Identifier: BSD-2-Clause
#include "freeflight/any_sampler.h"

#include "transmittance/variant_names.h"

namespace pbrtmedia {

std::string_view nameOf(const AnySampler& sampler) { return alternativeName(sampler); }
std::optional<AnySampler> findSampler(std::string_view name) { return findAlternative<AnySampler>(name); }
std::vector<std::string_view> samplerNames() { return alternativeNames<AnySampler>(); }

SamplerTraits traitsOf(const AnySampler& sampler) {
  return std::visit([](const auto& held) { return held.traits(); }, sampler);
}
std::vector<ParameterDescription> parametersOf(const AnySampler& sampler) {
  return std::visit([](const auto& held) { return describeParameters(held); }, sampler);
}
AssignResult setParameter(AnySampler& sampler, std::string_view name, const ParameterValue& value) {
  return std::visit([&](auto& held) { return assignParameter(held, name, value); }, sampler);
}

}  // namespace pbrtmedia
