// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string_view>

#include "fields/grid_field.h"
#include "fields/nano_vdb_field.h"
#include "fields/procedural_field.h"
#include "media/emission_pattern.h"
#include "media/field_medium_params.h"
#include "media/medium.h"

namespace pbrtmedia {

// Media whose bounds do not come from their data: constant or progressive, as params.bounds says. `pattern`:
// as of FieldMedium. Throw SceneError (location unknown) when a parameter is out of range.

std::unique_ptr<Medium> makeUnprovenMedium(const FieldMediumParams& params, std::string_view typeName,
                                           GridField field);
std::unique_ptr<Medium> makeUnprovenMedium(const FieldMediumParams& params, std::string_view typeName,
                                           NanoVdbField field);
std::unique_ptr<Medium> makeUnprovenMedium(const FieldMediumParams& params, std::string_view typeName,
                                           ProceduralField field);

}  // namespace pbrtmedia
