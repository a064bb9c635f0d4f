// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "transmittance/ratio_tracking.h"
#include "transmittance/regular_tracking.h"

namespace pbrtmedia {

/// The one list of transmittance estimators. A new one is its header and one word here; parser, help text,
/// contract tests and benchmarks walk this type. The first is the default.
using AnyEstimator = std::variant<RatioTracking, RegularTracking>;

/// The keyword of an estimator.
std::string_view nameOf(const AnyEstimator& estimator);
/// The estimator called `name`, with its default parameters; nothing when there is none.
std::optional<AnyEstimator> findEstimator(std::string_view name);
/// All keywords, default first.
std::vector<std::string_view> estimatorNames();

}  // namespace pbrtmedia
