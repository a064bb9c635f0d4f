// SPDX-License-Identifier: BSD-2-Clause
#include "media/nano_vdb_medium.h"

#include <utility>

#include "media/field_kernel.h"
#include "media/field_medium.h"
#include "media/medium_bounds.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeNanoVdbMedium(const NanoVdbMediumParams& params,
                                          const Transform& worldFromMedium) {
  NanoVdbField field(params.field, worldFromMedium);
  FieldBounds bounds = boundsOf(params, field);
  return std::make_unique<FieldMedium>(
      params, NanoVdbField::kTypeName,
      std::make_unique<FieldKernel<NanoVdbField>>(std::move(field), std::move(bounds)));
}

}  // namespace pbrtmedia
