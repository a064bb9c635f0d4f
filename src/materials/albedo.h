// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/bsdf.h"

namespace pbrtmedia {

/// The share of white light from all around that a surface sends toward `wo` (unit, away from it), reflected
/// and transmitted: ∫ f |cos| over directions, specular lobes included. By 16 fixed points for each lobe, so
/// it is the same wherever it is asked for: exact up to rounding where sampling follows f |cos| (diffuse and
/// perfectly specular lobes), else within some percent.
Rgb albedoOf(const Bsdf& bsdf, Vector3f wo);

}  // namespace pbrtmedia
