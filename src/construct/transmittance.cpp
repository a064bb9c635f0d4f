// SPDX-License-Identifier: BSD-2-Clause
#include "construct/transmittance.h"

#include <string>
#include <string_view>
#include <vector>

#include "construct/tracking_parameters.h"

namespace pbrtmedia {
namespace {

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
        text += "\" serves " + joinedNames(traitsOf(estimator).laws.names()) + "; the law \"" + *name +
                "\" is served by " + joinedNames(estimatorsThatServe(*law));
        in.error(ParamKind::String, "law", text);
      }
    } else {
      in.error(ParamKind::String, "law", "unknown law \"" + *name + "\"" + suggestion(*name, lawNames()));
    }
  }
  const EstimatorTraits traits = traitsOf(estimator);
  std::string what = "estimator \"";
  what += nameOf(estimator);
  what += '"';
  warnOfBias(in, "transmittance", what, traits.bias, traits.biasNote);
  return estimator;
}

}  // namespace pbrtmedia
