// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "construct/medium_kinds.h"
#include "media/emission/emission_patterns.h"
#include "media/field_medium_params.h"
#include "scene/description.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// Reads what every medium emits: "Le" and one "Lescale".
void readEmission(ParamReader& in, const MediumDescription& medium, MediumParams& p);

/// Makes the pattern of an emission, given the medium's place. Empty: there is none.
using EmissionPlan = std::function<std::shared_ptr<const EmissionPattern>(const Transform& worldFromMedium)>;

/// The grids beside: "Lescale" or "temperature" for each sample of `grid`, whose density is not needed; both
/// are multiplied.
EmissionPlan readGridEmission(const MediumInput& input, const GridField::Params& grid, FieldMediumParams& p);
/// "Legrid" or "temperaturegrid" of the .nvdb file; both are multiplied.
EmissionPlan readNanoVdbEmission(const MediumInput& input, const std::filesystem::path& file,
                                 FieldMediumParams& p);

}  // namespace pbrtmedia
