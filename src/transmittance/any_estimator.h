// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "transmittance/any_exponential_estimator.h"
#include "transmittance/gamma.h"
#include "transmittance/law.h"
#include "transmittance/parameters.h"
#include "transmittance/pink_p_cumulative.h"
#include "transmittance/taylor_pink_noise.h"
#include "transmittance/traits.h"
#include "transmittance/variant_names.h"

namespace pbrtmedia {

/// All transmittance estimators: the list of any_exponential_estimator.h, and here those that are built over
/// it or serve no exponential law. A new one is its header and one word in one of the two; parser, help text,
/// contract tests, the lab, docs and benchmarks walk this type. The first is the default.
using AnyEstimator = AppendedVariant<AnyExponentialEstimator, TaylorPinkNoise, PinkPCumulative, Gamma>;

/// The keyword of an estimator.
std::string_view nameOf(const AnyEstimator& estimator);
/// The estimator called `name`, with its default parameters; nothing when there is none.
std::optional<AnyEstimator> findEstimator(std::string_view name);
/// All keywords, default first.
std::vector<std::string_view> estimatorNames();

EstimatorTraits traitsOf(const AnyEstimator& estimator);
std::vector<ParameterDescription> parametersOf(const AnyEstimator& estimator);
AssignResult setParameter(AnyEstimator& estimator, std::string_view name, const ParameterValue& value);
/// The law it works under now.
AnyLaw lawOf(const AnyEstimator& estimator);
/// Puts the estimator under a law; false, changing nothing, when it cannot serve that one.
bool setLaw(AnyEstimator& estimator, const AnyLaw& law);

}  // namespace pbrtmedia
