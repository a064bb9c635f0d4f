// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>
#include <vector>

#include "base/parameters.h"
#include "transmittance/any_exponential_estimator.h"
#include "transmittance/traits.h"

// Of estimators that are built over another one, which estimates exponential transmittance.
namespace pbrtmedia {

EstimatorTraits traitsOf(const AnyExponentialEstimator& base);
/// `base`, a keyword, then the parameters of the base (parameters.h).
std::vector<ParameterDescription> describeBase(const AnyExponentialEstimator& base);
/// Naming a base resets its parameters.
AssignResult assignBase(AnyExponentialEstimator& base, std::string_view name, const ParameterValue& value);

}  // namespace pbrtmedia
