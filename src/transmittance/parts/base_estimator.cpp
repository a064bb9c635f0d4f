// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/base_estimator.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/variant_names.h"

namespace pbrtmedia {

EstimatorTraits traitsOf(const AnyExponentialEstimator& base) {
  return std::visit([](const auto& held) { return held.traits(); }, base);
}

std::vector<ParameterDescription> describeBase(const AnyExponentialEstimator& base) {
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

AssignResult assignBase(AnyExponentialEstimator& base, std::string_view name, const ParameterValue& value) {
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
  text += describeBase(base).front().allowed;
  return {.known = true, .error = std::move(text)};
}

}  // namespace pbrtmedia
