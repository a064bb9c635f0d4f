// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "fields/field_bounds.h"
#include "media/field_medium_params.h"

namespace pbrtmedia {

/// The bounds that do not come from data, constant or learned, which params.bounds asks for. Throws
/// SceneError (location unknown) when a parameter is out of range.
FieldBounds unprovenBounds(const FieldMediumParams& params, const SuperVoxelLattice& cells);

}  // namespace pbrtmedia
