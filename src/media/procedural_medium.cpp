// SPDX-License-Identifier: BSD-2-Clause
#include "media/procedural_medium.h"

#include <utility>

#include "base/diagnostics.h"
#include "media/field_kernel.h"
#include "media/field_medium.h"
#include "media/medium_bounds.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeProceduralMedium(const ProceduralMediumParams& params, std::string_view typeName,
                                             const Transform& worldFromMedium) {
  ProceduralField field(params.field, worldFromMedium);
  const SuperVoxelLattice cells = field.lattice(params.bounds.cells);
  std::optional<FieldBounds> bounds;
  if (params.bounds.source != BoundsParams::Source::Exact) {
    bounds = unprovenBounds(params, cells);
  } else if (std::optional<SuperVoxels> own = field.superVoxels(cells)) {
    bounds = FieldBounds::proven(*std::move(own));
  } else {
    throw SceneError(SourceLocation{}, params.field.function->describe() +
                                           " knows no bounds of its own: \"string bounds\" must be "
                                           "\"progressive\", or \"constant\" with a \"float majorant\"");
  }
  return std::make_unique<FieldMedium>(
      params, typeName, std::make_unique<FieldKernel<ProceduralField>>(std::move(field), *std::move(bounds)));
}

}  // namespace pbrtmedia
