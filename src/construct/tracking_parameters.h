// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameters.h"
#include "scene/param_reader.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// The value that the scene gives to a described parameter, if it does; `kind`: as what.
std::optional<ParameterValue> readValue(ParamReader& in, const ParameterDescription& d, ParamKind& kind);

/// Sets what the scene says of the parameters of `target`, which has parametersOf and setParameter: an
/// estimator, a law, a free-flight sampler. One of them may bring others with it (the base of an estimator
/// over another), so the list is read again until it stays. Returns
/// whether it says anything.
template <class Target>
bool readParameters(ParamReader& in, Target& target) {
  std::set<std::string> done;
  bool any = false;
  for (bool grew = true; grew;) {
    grew = false;
    for (const ParameterDescription& d : parametersOf(target)) {
      if (!done.insert(d.name).second) continue;
      grew = true;
      ParamKind kind{};
      const std::optional<ParameterValue> value = readValue(in, d, kind);
      if (!value) continue;
      any = true;
      if (const AssignResult r = setParameter(target, d.name, *value); r.error)
        in.error(kind, d.name, *r.error);
    }
  }
  return any;
}

/// A warning at the parameter `choice` for a method that is not unbiased: what it is, and how much.
void warnOfBias(ParamReader& in, std::string_view choice, std::string_view what, EstimatorTraits::Bias bias,
                std::string_view biasNote);

/// "a, b, c"
std::string joinedNames(const std::vector<std::string_view>& names);

}  // namespace pbrtmedia
