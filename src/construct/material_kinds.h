// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "construct/materials.h"

// Readers of material types that stand in files of their own.

namespace pbrtmedia {

/// Says that indices of refraction beyond those for which light that comes from below the surface is known
/// count as the nearest of them, in this.
void warnOfIndexBelowSurface(Texturable& in, float eta);

Materials::Make readDisney(Texturable& in);
Materials::Make readFourier(Texturable& in);
Materials::Make readHair(Texturable& in);
Materials::Make readKdSubsurface(Texturable& in);
Materials::Make readSubsurface(Texturable& in);

}  // namespace pbrtmedia
