// SPDX-License-Identifier: BSD-2-Clause
#include "construct/freeflight.h"

#include <string>
#include <string_view>
#include <vector>

#include "construct/tracking_parameters.h"
#include "media/tracking_choice.h"

namespace pbrtmedia {

namespace {

std::string samplersThatServe(const AnyLaw& law) {
  std::vector<std::string_view> names = samplerNames();
  std::erase_if(names, [&](std::string_view name) { return !traitsOf(*findSampler(name)).laws.has(law); });
  return joinedNames(names);
}

}  // namespace

AnySampler readFreeFlight(ParamReader& in, const AnyLaw& law, bool walksPieces, bool scatters) {
  AnySampler sampler;
  const std::optional<std::string> name = in.optionalString("freeflight");
  if (std::optional<AnySampler> found = findSampler(name.value_or("auto"))) {
    sampler = *std::move(found);
  } else if (name && *name != "auto") {
    std::vector<std::string_view> names = samplerNames();
    names.push_back("auto");
    in.error(ParamKind::String, "freeflight",
             "unknown free-flight sampler \"" + *name + "\"" + suggestion(*name, names));
  }
  if ((!name || *name == "auto") && walksPieces && scatters && !traitsOf(sampler).laws.has(law)) {
    sampler = samplerOfAnyLaw();
  }
  readParameters(in, sampler);
  const SamplerTraits traits = traitsOf(sampler);
  if (scatters && !traits.laws.has(law)) {
    std::string text = "the free flights of \"";
    text += nameOf(sampler);
    text += "\" follow " + joinedNames(traits.laws.names()) + "; for a medium that scatters, the law \"";
    text += nameOf(law);
    text += "\" is served by " + samplersThatServe(law);
    in.error(ParamKind::String, name ? "freeflight" : "law", text);
  }
  std::string what = "free-flight sampler \"";
  what += nameOf(sampler);
  what += '"';
  warnOfBias(in, "freeflight", what, traits.bias, traits.biasNote);
  return sampler;
}

}  // namespace pbrtmedia
