// SPDX-License-Identifier: BSD-2-Clause
#include "media/grid_medium.h"

#include <utility>

#include "media/field_kernel.h"
#include "media/field_medium.h"
#include "media/medium_bounds.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeGridMedium(const GridMediumParams& params, const Transform& worldFromMedium) {
  GridField field(params.grid, worldFromMedium);
  FieldBounds bounds = boundsOf(params, field);
  return std::make_unique<FieldMedium>(
      params, "heterogeneous", std::make_unique<FieldKernel<GridField>>(std::move(field), std::move(bounds)));
}

}  // namespace pbrtmedia
