// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "media/field_medium_params.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// Reads `"integer supervoxels"`, `"string bounds"` and what belongs to them. `fallback`: where bounds come
/// from when the scene does not say.
BoundsParams readBounds(ParamReader& in, BoundsParams::Source fallback);

/// An error for an estimator or a sampler that needs a density in cubic pieces where there are none: the
/// field is procedural, or the bounds are not exact. `inPieces`: the field itself is piecewise cubic.
void checkPieces(ParamReader& in, const FieldMediumParams& p, bool inPieces);

}  // namespace pbrtmedia
