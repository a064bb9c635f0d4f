// SPDX-License-Identifier: BSD-2-Clause
#include "construct/freeflight.h"

#include <string>

#include "construct/tracking_parameters.h"

namespace pbrtmedia {

AnySampler readFreeFlight(ParamReader& in, AnySampler fallback) {
  AnySampler sampler = std::move(fallback);
  if (const std::optional<std::string> name = in.optionalString("freeflight")) {
    if (std::optional<AnySampler> found = findSampler(*name)) {
      sampler = *std::move(found);
    } else {
      in.error(ParamKind::String, "freeflight",
               "unknown free-flight sampler \"" + *name + "\"" + suggestion(*name, samplerNames()));
    }
  }
  readParameters(in, sampler);
  const SamplerTraits traits = traitsOf(sampler);
  std::string what = "free-flight sampler \"";
  what += nameOf(sampler);
  what += '"';
  warnOfBias(in, "freeflight", what, traits.bias, traits.biasNote);
  return sampler;
}

}  // namespace pbrtmedia
