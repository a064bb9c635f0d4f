// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "base/transform.h"
#include "fields/grid_field.h"
#include "media/field_medium_params.h"
#include "media/medium.h"

namespace pbrtmedia {

/// A medium on a density grid: PBRT-v3's "heterogeneous". Equal sigma_t in R, G, B runs one channel, others
/// three. Throws SceneError (location unknown) for bad parameters.
struct GridMediumParams : FieldMediumParams {
  GridField::Params grid;
};
std::unique_ptr<Medium> makeGridMedium(const GridMediumParams& params, const Transform& worldFromMedium);

}  // namespace pbrtmedia
