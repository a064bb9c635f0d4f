// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "media/phase/phase_function.h"

namespace pbrtmedia {

/// One term of a medium's phase function, as scenes name it.
struct PhaseLobe {
  enum class Kind { HenyeyGreenstein, Rayleigh, Isotropic };
  static constexpr std::array<std::string_view, 3> kNames = {"henyeygreenstein", "rayleigh", "isotropic"};

  Kind kind = Kind::HenyeyGreenstein;
  float g = 0;       ///< mean cosine in (-1, 1); Henyey-Greenstein only
  float weight = 1;  ///< >= 0, relative to the other lobes
};

/// The phase function of these lobes. Throws SceneError (location unknown) for an empty list, g or weights
/// out of range.
std::unique_ptr<PhaseFunction> makePhaseFunction(const std::vector<PhaseLobe>& lobes);

}  // namespace pbrtmedia
