// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "media/field_medium_params.h"
#include "media/medium_params.h"
#include "scene/description.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// Reads what every medium has: coefficients (preset, explicit, scale), phase function, overlap rule.
void readMediumParams(ParamReader& in, const MediumDescription& medium, MediumParams& p);

/// Whether a density can be walked from voxel to voxel.
enum class DensityKind { InPieces, Procedural };

/// Reads what every medium with a density field has: the above, the ways of tracking and the bounds.
void readFieldMediumParams(ParamReader& in, const MediumDescription& medium, DensityKind kind,
                           FieldMediumParams& p);

/// Reads the box of a density, "point p0" and "point p1". False after an error: it is flat.
bool readMediumBox(ParamReader& in, Point3f& p0, Point3f& p1);

}  // namespace pbrtmedia
