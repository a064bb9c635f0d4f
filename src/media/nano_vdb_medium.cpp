// SPDX-License-Identifier: BSD-2-Clause
#include "media/nano_vdb_medium.h"

#include <utility>

#include "media/field_medium.h"
#include "media/unproven_medium.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeNanoVdbMedium(const NanoVdbMediumParams& params,
                                          const Transform& worldFromMedium) {
  NanoVdbField field(params.field, worldFromMedium);
  if (params.bounds.source != BoundsParams::Source::Exact)
    return makeUnprovenMedium(params, NanoVdbField::kTypeName, std::move(field));
  SuperVoxels bounds = field.superVoxels(field.lattice(params.bounds.cells));
  return std::make_unique<FieldMedium<NanoVdbField>>(params, NanoVdbField::kTypeName, std::move(field),
                                                     std::move(bounds));
}

}  // namespace pbrtmedia
