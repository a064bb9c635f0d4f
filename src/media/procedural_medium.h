// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string_view>

#include "base/transform.h"
#include "fields/procedural_field.h"
#include "media/field_medium_params.h"
#include "media/medium.h"

namespace pbrtmedia {

/// A medium whose density is a function inside a box. Throws SceneError (location unknown) for bad
/// parameters, and for exact bounds of a function that knows no ranges. `typeName`: static.
struct ProceduralMediumParams : FieldMediumParams {
  ProceduralField::Params field;
};
std::unique_ptr<Medium> makeProceduralMedium(const ProceduralMediumParams& params, std::string_view typeName,
                                             const Transform& worldFromMedium);

}  // namespace pbrtmedia
