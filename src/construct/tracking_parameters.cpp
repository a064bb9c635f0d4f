// SPDX-License-Identifier: BSD-2-Clause
#include "construct/tracking_parameters.h"

namespace pbrtmedia {

std::optional<ParameterValue> readValue(ParamReader& in, const ParameterDescription& d, ParamKind& kind) {
  const auto as = [](auto found) -> std::optional<ParameterValue> {
    if (!found) return std::nullopt;
    return ParameterValue(*found);
  };
  if (d.type == "bool") {
    kind = ParamKind::Bool;
    return as(in.optionalBool(d.name));
  }
  if (d.type == "string") {
    kind = ParamKind::String;
    return as(in.optionalString(d.name));
  }
  if (d.type == "integer") {
    kind = ParamKind::Integer;
    if (const std::optional<int> i = in.optionalInt(d.name)) return ParameterValue(static_cast<double>(*i));
    return std::nullopt;
  }
  kind = ParamKind::Float;
  if (const std::optional<float> f = in.optionalFloat(d.name)) return ParameterValue(decimalOf(*f));
  return std::nullopt;
}

void warnOfBias(ParamReader& in, std::string_view choice, std::string_view what, EstimatorTraits::Bias bias,
                std::string_view biasNote) {
  if (bias == EstimatorTraits::Bias::Unbiased) return;
  std::string text = in.context();
  text += ": ";
  text += what;
  text += " is ";
  text += nameOf(bias);
  text += ": ";
  text += biasNote;
  in.diagnostics().warning(in.locationOf(ParamKind::String, choice), text);
}

std::string joinedNames(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

}  // namespace pbrtmedia
