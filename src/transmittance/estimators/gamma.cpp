// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/gamma.h"

#include <optional>
#include <string>

#include "base/variant_names.h"

namespace pbrtmedia {

EstimatorTraits Gamma::traits() const {
  const EstimatorTraits of = std::visit([](const auto& held) { return held.traits(); }, base);
  // Estimates in [0, 1] have a finite variance whatever gamma is. Those beyond may grow faster with gamma
  // than its density falls.
  const bool finite = of.finiteVariance && !of.mayLeaveUnitInterval;
  return {
      .summary = "an exponential estimator in a medium scaled by a random factor of the gamma distribution",
      .source = "Bitterli et al. 2018; Misso et al. 2022, section 5.2",
      .useWhen = "the law is pink noise and an estimator for the exponential law does well",
      .bias = of.bias,
      .biasNote = of.biasNote,
      .mayLeaveUnitInterval = of.mayLeaveUnitInterval,
      .control = of.control,
      .finiteVariance = finite,
      .finiteVarianceUnbounded =
          finite && of.finiteVarianceUnbounded && of.control == EstimatorTraits::Control::Unused,
      .boundedCost = of.boundedCost,
      .needsPieces = of.needsPieces,
      .laws = LawSet::pinkNoise()};
}

std::vector<ParameterDescription> Gamma::describe() const {
  ParameterDescription first{"base", "string", std::string(alternativeName(base)), "",
                             "estimator of exponential transmittance; its parameters are set after it"};
  for (const std::string_view name : alternativeNames<AnyExponentialEstimator>()) {
    if (!first.allowed.empty()) first.allowed += ", ";
    first.allowed += name;
  }
  std::vector<ParameterDescription> all{first};
  for (ParameterDescription& d : std::visit([](const auto& b) { return describeParameters(b); }, base)) {
    all.push_back(std::move(d));
  }
  return all;
}

AssignResult Gamma::assign(std::string_view name, const ParameterValue& value) {
  if (name != "base") return std::visit([&](auto& held) { return assignParameter(held, name, value); }, base);
  const std::string* keyword = std::get_if<std::string>(&value);
  if (std::optional<AnyExponentialEstimator> found =
          keyword != nullptr ? findAlternative<AnyExponentialEstimator>(*keyword) : std::nullopt) {
    base = *std::move(found);
    return {.known = true, .error = std::nullopt};
  }
  std::string text = "found ";
  text += textOf(value);
  text += ", expected one of ";
  text += describe().front().allowed;
  return {.known = true, .error = std::move(text)};
}

}  // namespace pbrtmedia
