// SPDX-License-Identifier: BSD-2-Clause
#include "freeflight/any_sampler.h"

#include "base/variant_names.h"
#include "freeflight/sampler_list.h"

namespace pbrtmedia {
namespace {

AnySampler holding(SamplerVariant variant) {
  return AnySampler(std::make_shared<const AnySampler::Held>(AnySampler::Held{std::move(variant)}));
}

}  // namespace

AnySampler::AnySampler() : held_(std::make_shared<const Held>()) {}

std::string_view nameOf(const AnySampler& sampler) { return alternativeName(sampler.held().variant); }
std::optional<AnySampler> findSampler(std::string_view name) {
  auto found = findAlternative<SamplerVariant>(name);
  if (!found) return std::nullopt;
  return holding(*std::move(found));
}
std::vector<std::string_view> samplerNames() { return alternativeNames<SamplerVariant>(); }

SamplerTraits traitsOf(const AnySampler& sampler) {
  return visitSampler([](const auto& held) { return held.traits(); }, sampler);
}
std::vector<ParameterDescription> parametersOf(const AnySampler& sampler) {
  return visitSampler([](const auto& held) { return describeParameters(held); }, sampler);
}
AssignResult setParameter(AnySampler& sampler, std::string_view name, const ParameterValue& value) {
  SamplerVariant changed = sampler.held().variant;
  AssignResult result = std::visit([&](auto& held) { return assignParameter(held, name, value); }, changed);
  sampler = holding(std::move(changed));
  return result;
}

}  // namespace pbrtmedia
