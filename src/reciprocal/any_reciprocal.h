// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/parameters.h"
#include "reciprocal/reciprocal_bernoulli.h"
#include "reciprocal/reciprocal_march.h"
#include "reciprocal/reciprocal_p_cumulative.h"
#include "reciprocal/reciprocal_taylor.h"
#include "reciprocal/reciprocal_telescoping.h"

namespace pbrtmedia {

/// The one list of estimators of 1/F, F > 0 being the integral of sigmaT[c] times the density over a line. A
/// new one is its header and one word here; the lab, docs and contract tests walk this type.
///
/// An estimator is a small immutable value: kName, traits(), parameters() (base/parameters.h), and
///   template <DensityLine Line, std::size_t N>
///   Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const;
/// which counts its look-ups. Where F is known to be 0 the answer is infinite.
using AnyReciprocal = std::variant<ReciprocalPCumulative, ReciprocalBernoulli, ReciprocalTaylor,
                                   ReciprocalTelescoping, ReciprocalMarch>;

std::string_view nameOf(const AnyReciprocal& estimator);
/// The estimator called `name`, with its default parameters; nothing when there is none.
std::optional<AnyReciprocal> findReciprocal(std::string_view name);
std::vector<std::string_view> reciprocalNames();
ReciprocalTraits traitsOf(const AnyReciprocal& estimator);
std::vector<ParameterDescription> parametersOf(const AnyReciprocal& estimator);
AssignResult setParameter(AnyReciprocal& estimator, std::string_view name, const ParameterValue& value);

}  // namespace pbrtmedia
