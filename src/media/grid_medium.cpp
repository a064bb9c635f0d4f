// SPDX-License-Identifier: BSD-2-Clause
#include "media/grid_medium.h"

#include <utility>

#include "media/field_medium.h"
#include "media/unproven_medium.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeGridMedium(const GridMediumParams& params, const Transform& worldFromMedium) {
  GridField field(params.grid, worldFromMedium);
  constexpr std::string_view kTypeName = "heterogeneous";
  if (params.bounds.source != BoundsParams::Source::Exact)
    return makeUnprovenMedium(params, kTypeName, std::move(field));
  SuperVoxels bounds = field.superVoxels(field.lattice(params.bounds.cells));
  return std::make_unique<FieldMedium<GridField>>(params, kTypeName, std::move(field), std::move(bounds));
}

std::unique_ptr<Medium> makeConstantMedium(const ConstantMediumParams& params,
                                           const Transform& worldFromMedium) {
  ConstantField field(params.field, worldFromMedium);
  SuperVoxels bounds = field.superVoxels();
  return std::make_unique<FieldMedium<ConstantField>>(params, ConstantField::kTypeName, std::move(field),
                                                      std::move(bounds));
}

}  // namespace pbrtmedia
