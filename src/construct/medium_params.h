// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "media/field_medium_params.h"
#include "media/medium_params.h"
#include "scene/description.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// Reads what every medium has: coefficients (preset, explicit, scale), phase function, overlap rule.
void readMediumParams(ParamReader& in, const MediumDescription& medium, MediumParams& p);

/// Reads what every medium with a density field has: the above and the ways of tracking.
void readFieldMediumParams(ParamReader& in, const MediumDescription& medium, FieldMediumParams& p);

}  // namespace pbrtmedia
