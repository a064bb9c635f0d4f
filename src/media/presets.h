// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A measured scattering medium: coefficients in 1/mm, reduced scattering, meant for an isotropic phase
/// function (g = 0).
struct MediumPreset {
  std::string_view name;
  Rgb sigmaPrimeS;  ///< reduced scattering, 1/mm
  Rgb sigmaA;       ///< absorption, 1/mm
};

/// The preset of exactly this name (case matters); nothing when there is none.
std::optional<MediumPreset> findPreset(std::string_view name);
/// All presets: 12 of Jensen et al. 2001, doi:10.1145/383259.383319, then those of Narasimhan et al. 2006,
/// doi:10.1145/1141911.1141986.
std::span<const MediumPreset> mediumPresets();

}  // namespace pbrtmedia
