// SPDX-License-Identifier: BSD-2-Clause
#include "construct/transmittance.h"

#include <string>
#include <string_view>
#include <vector>

#include "construct/tracking_parameters.h"
#include "media/tracking_choice.h"

namespace pbrtmedia {
namespace {

std::vector<std::string_view> estimatorsThatServe(const AnyLaw& law, bool walksPieces) {
  std::vector<std::string_view> names = estimatorNames();
  std::erase_if(names, [&](std::string_view name) {
    const EstimatorTraits traits = traitsOf(*findEstimator(name));
    return !traits.laws.has(law) || (traits.needsPieces && !walksPieces);
  });
  return names;
}

}  // namespace

std::optional<AnyEstimator> readTransmittance(ParamReader& in, bool walksPieces) {
  const std::optional<std::string> name = in.optionalString("transmittance");
  bool isAuto = !name || *name == "auto";
  AnyEstimator estimator = ratioTrackingWithRoulette();
  if (name && !isAuto) {
    if (std::optional<AnyEstimator> found = findEstimator(*name)) {
      estimator = *std::move(found);
    } else {
      std::vector<std::string_view> names = estimatorNames();
      names.push_back("auto");
      in.error(ParamKind::String, "transmittance",
               "unknown estimator \"" + *name + "\"" + suggestion(*name, names));
    }
  }
  // Whoever says "auto" leaves the parameters to it too.
  if (!name || !isAuto) {
    if (readParameters(in, estimator)) isAuto = false;
  }
  if (const std::optional<std::string> lawName = in.optionalString("law")) {
    if (std::optional<AnyLaw> law = findLaw(*lawName)) {
      readParameters(in, *law);
      if (isAuto && !traitsOf(estimator).laws.has(*law)) {
        isAuto = false;
        estimator = estimatorOfAnyLaw(walksPieces);
      }
      if (!setLaw(estimator, *law)) {
        std::string text = "estimator \"";
        text += nameOf(estimator);
        text += "\" serves " + joinedNames(traitsOf(estimator).laws.names()) + "; the law \"" + *lawName +
                "\" is served by " + joinedNames(estimatorsThatServe(*law, walksPieces));
        in.error(ParamKind::String, "law", text);
      }
    } else {
      in.error(ParamKind::String, "law",
               "unknown law \"" + *lawName + "\"" + suggestion(*lawName, lawNames()));
    }
  }
  if (isAuto) return std::nullopt;
  const EstimatorTraits traits = traitsOf(estimator);
  std::string what = "estimator \"";
  what += nameOf(estimator);
  what += '"';
  warnOfBias(in, "transmittance", what, traits.bias, traits.biasNote);
  return estimator;
}

}  // namespace pbrtmedia
