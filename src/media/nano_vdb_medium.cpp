// SPDX-License-Identifier: BSD-2-Clause
#include "media/nano_vdb_medium.h"

#include <utility>

#include "media/field_medium.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeNanoVdbMedium(const NanoVdbMediumParams& params,
                                          const Transform& worldFromMedium) {
  NanoVdbField field(params.field, worldFromMedium);
  SuperVoxels bounds = field.superVoxels();
  return std::make_unique<FieldMedium<NanoVdbField>>(params, NanoVdbField::kTypeName, std::move(field),
                                                     std::move(bounds));
}

}  // namespace pbrtmedia
