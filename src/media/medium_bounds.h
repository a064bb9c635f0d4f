// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "fields/field_bounds.h"
#include "media/field_medium_params.h"

namespace pbrtmedia {

/// The bounds that do not come from data, constant or learned, which params.bounds asks for. Throws
/// SceneError (location unknown) when a parameter is out of range.
FieldBounds unprovenBounds(const FieldMediumParams& params, const SuperVoxelLattice& cells);

/// The bounds that params.bounds asks for, of a field that knows its own.
template <class Field>
FieldBounds boundsOf(const FieldMediumParams& params, const Field& field) {
  const SuperVoxelLattice cells = field.lattice(params.bounds.cells);
  return params.bounds.source == BoundsParams::Source::Exact ? FieldBounds::proven(field.superVoxels(cells))
                                                             : unprovenBounds(params, cells);
}

}  // namespace pbrtmedia
