// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "construct/media.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

// One reader for each class of medium: all parameters checked, problems reported. Nothing after an error.

std::optional<MediumPlan> readHomogeneousMedium(ParamReader& in, const MediumDescription& medium);
std::optional<MediumPlan> readHeterogeneousMedium(ParamReader& in, const MediumDescription& medium);
std::optional<MediumPlan> readNanoVdbMedium(ParamReader& in, const MediumDescription& medium);
std::optional<MediumPlan> readPerlinMedium(ParamReader& in, const MediumDescription& medium);
std::optional<MediumPlan> readAnalyticMedium(ParamReader& in, const MediumDescription& medium);
std::optional<MediumPlan> readTextureMedium(ParamReader& in, const MediumDescription& medium);

}  // namespace pbrtmedia
