// SPDX-License-Identifier: BSD-2-Clause
#include "media/procedural_medium.h"

#include <utility>

#include "base/diagnostics.h"
#include "media/field_medium.h"
#include "media/unproven_medium.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeProceduralMedium(const ProceduralMediumParams& params, std::string_view typeName,
                                             const Transform& worldFromMedium) {
  ProceduralField field(params.field, worldFromMedium);
  if (params.bounds.source != BoundsParams::Source::Exact)
    return makeUnprovenMedium(params, typeName, std::move(field));
  std::optional<SuperVoxels> bounds = field.superVoxels(field.lattice(params.bounds.cells));
  if (!bounds) {
    throw SceneError(SourceLocation{}, params.field.function->describe() +
                                           " knows no bounds of its own: \"string bounds\" must be "
                                           "\"progressive\", or \"constant\" with a \"float majorant\"");
  }
  return std::make_unique<FieldMedium<ProceduralField>>(params, typeName, std::move(field),
                                                        std::move(bounds));
}

}  // namespace pbrtmedia
