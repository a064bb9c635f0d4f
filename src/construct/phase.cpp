// SPDX-License-Identifier: BSD-2-Clause
#include "construct/phase.h"

#include <algorithm>
#include <string>

namespace pbrtmedia {

std::vector<PhaseLobe> readPhase(ParamReader& in) {
  std::vector<PhaseLobe> lobes;
  for (const std::string& word : in.strings("phase")) {
    const auto at = std::find(PhaseLobe::kNames.begin(), PhaseLobe::kNames.end(), word);
    if (at == PhaseLobe::kNames.end()) {
      in.error(ParamKind::String, "phase",
               "unknown phase function \"" + word + "\"" + suggestion(word, PhaseLobe::kNames));
    } else {
      lobes.push_back({static_cast<PhaseLobe::Kind>(at - PhaseLobe::kNames.begin()), 0, 1});
    }
  }
  if (lobes.empty())
    return {PhaseLobe{PhaseLobe::Kind::HenyeyGreenstein, in.findFloat("g", 0, Range::open(-1, 1))}};
  const std::span<const float> g = in.floats("g"), weights = in.floats("phaseweight");
  const auto asymmetric =
      static_cast<std::size_t>(std::count_if(lobes.begin(), lobes.end(), [](const PhaseLobe& l) {
        return l.kind == PhaseLobe::Kind::HenyeyGreenstein;
      }));
  const auto checkCount = [&](std::string_view name, std::size_t found, std::size_t expected,
                              const char* each) {
    if (found == 0 || found == expected) return true;
    std::string text = "found ";
    text +=
        std::to_string(found) + " numbers, expected one for each " + each + ": " + std::to_string(expected);
    in.error(ParamKind::Float, name, text);
    return false;
  };
  if (checkCount("g", g.size(), asymmetric, "\"henyeygreenstein\"") && !g.empty()) {
    std::size_t next = 0;
    for (PhaseLobe& lobe : lobes) {
      if (lobe.kind == PhaseLobe::Kind::HenyeyGreenstein) lobe.g = g[next++];
    }
  }
  if (checkCount("phaseweight", weights.size(), lobes.size(), "phase function") && !weights.empty()) {
    for (std::size_t i = 0; i < lobes.size(); ++i) lobes[i].weight = weights[i];
  }
  for (const PhaseLobe& lobe : lobes) {
    if (!(lobe.g > -1 && lobe.g < 1)) {
      in.error(ParamKind::Float, "g", "found " + std::to_string(lobe.g) + ", expected in (-1, 1)");
    }
    if (!(lobe.weight >= 0))
      in.error(ParamKind::Float, "phaseweight", "found a negative weight, expected >= 0");
  }
  if (std::all_of(lobes.begin(), lobes.end(), [](const PhaseLobe& l) { return l.weight == 0; })) {
    in.error(ParamKind::Float, "phaseweight", "all weights are 0");
  }
  return lobes;
}

}  // namespace pbrtmedia
