// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "media/medium.h"
#include "media/phase/phase_params.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// What every medium has.
struct MediumParams {
  std::string name;
  Rgb sigmaA{.0011f, .0024f, .014f};  ///< absorption (at density 1), 1/world length, >= 0
  Rgb sigmaS{2.55f, 3.21f, 3.77f};    ///< scattering (at density 1), 1/world length, >= 0
  std::vector<PhaseLobe> phase = {PhaseLobe{}};
  OverlapRule overlap;
  Rgb le{0.0f};  ///< emitted radiance per unit absorption: sigma_a Le is gained per length
};

}  // namespace pbrtmedia
