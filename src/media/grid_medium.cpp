// SPDX-License-Identifier: BSD-2-Clause
#include "media/grid_medium.h"

#include <utility>

#include "media/field_kernel.h"
#include "media/field_medium.h"
#include "media/medium_bounds.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeGridMedium(const GridMediumParams& params, const Transform& worldFromMedium) {
  GridField field(params.grid, worldFromMedium);
  const SuperVoxelLattice cells = field.lattice(params.bounds.cells);
  FieldBounds bounds = params.bounds.source == BoundsParams::Source::Exact
                           ? FieldBounds::proven(field.superVoxels(cells))
                           : unprovenBounds(params, cells);
  return std::make_unique<FieldMedium>(
      params, "heterogeneous", std::make_unique<FieldKernel<GridField>>(std::move(field), std::move(bounds)));
}

}  // namespace pbrtmedia
