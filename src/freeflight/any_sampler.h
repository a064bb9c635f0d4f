// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "freeflight/delta_tracking.h"

namespace pbrtmedia {

/// The one list of free-flight samplers. A new one is its header and one word here. The first is the default.
using AnySampler = std::variant<DeltaTracking>;

/// The keyword of a sampler.
std::string_view nameOf(const AnySampler& sampler);
/// The sampler called `name`, with its default parameters; nothing when there is none.
std::optional<AnySampler> findSampler(std::string_view name);
/// All keywords, default first.
std::vector<std::string_view> samplerNames();

}  // namespace pbrtmedia
