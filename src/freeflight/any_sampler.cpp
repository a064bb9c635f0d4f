// SPDX-License-Identifier: BSD-2-Clause
#include "freeflight/any_sampler.h"

#include "transmittance/variant_names.h"

namespace pbrtmedia {

std::string_view nameOf(const AnySampler& sampler) { return alternativeName(sampler); }
std::optional<AnySampler> findSampler(std::string_view name) { return findAlternative<AnySampler>(name); }
std::vector<std::string_view> samplerNames() { return alternativeNames<AnySampler>(); }

}  // namespace pbrtmedia
