// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/parameters.h"
#include "freeflight/sampler_traits.h"

namespace pbrtmedia {

/// One of the free-flight samplers with its parameters. Knows none of their code, so that who chooses, holds
/// and describes samplers does not compile them; freeflight/sampler_list.h does. A value: copies share until
/// one is changed.
class AnySampler {
 public:
  struct Held;

  /// The first of the list.
  AnySampler();
  /// Of freeflight/sampler_list.h.
  template <class Sampler>
  requires requires { Sampler::kName; }
  AnySampler(const Sampler& sampler);
  explicit AnySampler(std::shared_ptr<const Held> held) : held_(std::move(held)) {}

  const Held& held() const { return *held_; }

 private:
  std::shared_ptr<const Held> held_;
};

/// The keyword of a sampler.
std::string_view nameOf(const AnySampler& sampler);
/// The sampler called `name`, with its default parameters; nothing when there is none.
std::optional<AnySampler> findSampler(std::string_view name);
/// All keywords, default first.
std::vector<std::string_view> samplerNames();

SamplerTraits traitsOf(const AnySampler& sampler);
std::vector<ParameterDescription> parametersOf(const AnySampler& sampler);
AssignResult setParameter(AnySampler& sampler, std::string_view name, const ParameterValue& value);

}  // namespace pbrtmedia
