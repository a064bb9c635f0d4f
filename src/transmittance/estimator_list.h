// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <utility>
#include <variant>

#include "base/variant_names.h"
#include "transmittance/any_estimator.h"
#include "transmittance/any_exponential_estimator.h"
#include "transmittance/estimators/gamma.h"
#include "transmittance/estimators/interval_product.h"
#include "transmittance/estimators/pink_p_cumulative.h"
#include "transmittance/estimators/taylor_pink_noise.h"

namespace pbrtmedia {

/// All transmittance estimators: the list of any_exponential_estimator.h, and here those that are built over
/// it or serve no exponential law. A new one is its header and one word in one of the two; parser, help text,
/// contract tests, the lab, docs and benchmarks walk this type. The first is the default.
using EstimatorVariant =
    AppendedVariant<AnyExponentialEstimator, TaylorPinkNoise, PinkPCumulative, Gamma, IntervalProduct>;

struct AnyEstimator::Held {
  EstimatorVariant variant;
};

template <class Estimator>
requires requires { Estimator::kName; }
AnyEstimator::AnyEstimator(const Estimator& estimator)
    : held_(std::make_shared<const Held>(Held{EstimatorVariant(estimator)})) {}

/// Calls `f` with the concrete estimator.
template <class F>
decltype(auto) visitEstimator(F&& f, const AnyEstimator& estimator) {
  return std::visit(std::forward<F>(f), estimator.held().variant);
}

}  // namespace pbrtmedia
