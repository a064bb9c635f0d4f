// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Throws SceneError (location unknown) unless both are finite and >= 0 in every channel, and so is their
/// sum.
void checkCoefficients(Rgb sigmaA, Rgb sigmaS, std::string_view mediumName);

/// The same for emitted radiance and sigma_a times it.
void checkEmission(Rgb le, Rgb emission, std::string_view mediumName);

/// sigma_s / sigma_t, 0 in channels without extinction.
Rgb albedoOf(Rgb sigmaS, Rgb sigmaT);

}  // namespace pbrtmedia
