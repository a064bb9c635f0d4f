// SPDX-License-Identifier: BSD-2-Clause
#include "construct/transmittance.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pbrtmedia {
namespace {

/// The value that the scene gives to a parameter, if it does.
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

/// Sets what the scene says of the parameters of `target`. One of them may bring others with it (the base of
/// an estimator over another), so the list is read again until it stays.
template <class Target>
void readParameters(ParamReader& in, Target& target) {
  std::set<std::string> done;
  for (bool grew = true; grew;) {
    grew = false;
    for (const ParameterDescription& d : parametersOf(target)) {
      if (!done.insert(d.name).second) continue;
      grew = true;
      ParamKind kind{};
      const std::optional<ParameterValue> value = readValue(in, d, kind);
      if (!value) continue;
      if (const AssignResult r = setParameter(target, d.name, *value); r.error)
        in.error(kind, d.name, *r.error);
    }
  }
}

std::string joined(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

std::vector<std::string_view> estimatorsThatServe(const AnyLaw& law) {
  std::vector<std::string_view> names;
  for (const std::string_view name : estimatorNames()) {
    if (traitsOf(*findEstimator(name)).laws.has(law)) names.push_back(name);
  }
  return names;
}

}  // namespace

AnyEstimator readTransmittance(ParamReader& in, AnyEstimator fallback) {
  AnyEstimator estimator = std::move(fallback);
  if (const std::optional<std::string> name = in.optionalString("transmittance")) {
    if (std::optional<AnyEstimator> found = findEstimator(*name)) {
      estimator = *std::move(found);
    } else {
      in.error(ParamKind::String, "transmittance",
               "unknown estimator \"" + *name + "\"" + suggestion(*name, estimatorNames()));
    }
  }
  readParameters(in, estimator);
  if (const std::optional<std::string> name = in.optionalString("law")) {
    if (std::optional<AnyLaw> law = findLaw(*name)) {
      readParameters(in, *law);
      if (!setLaw(estimator, *law)) {
        std::string text = "estimator \"";
        text += nameOf(estimator);
        text += "\" serves " + joined(traitsOf(estimator).laws.names()) + "; the law \"" + *name +
                "\" is served by " + joined(estimatorsThatServe(*law));
        in.error(ParamKind::String, "law", text);
      }
    } else {
      in.error(ParamKind::String, "law", "unknown law \"" + *name + "\"" + suggestion(*name, lawNames()));
    }
  }
  if (const EstimatorTraits traits = traitsOf(estimator); traits.bias != EstimatorTraits::Bias::Unbiased) {
    std::string text = in.context();
    text += ": estimator \"";
    text += nameOf(estimator);
    text += "\" is ";
    text += nameOf(traits.bias);
    text += ": ";
    text += traits.biasNote;
    in.diagnostics().warning(in.locationOf(ParamKind::String, "transmittance"), text);
  }
  return estimator;
}

}  // namespace pbrtmedia
