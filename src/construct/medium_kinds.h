// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "construct/media.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// What a reader of media gets.
struct MediumInput {
  ParamReader& in;
  const MediumDescription& medium;
  bool isUsed;            ///< false: files need only be there
  Diagnostics& building;  ///< for what is found while the plan is carried out
};

// One reader for each class of medium: all parameters checked, problems reported. Nothing after an error, and
// for what PBRT-v3 takes as vacuum.

std::optional<MediumPlan> readHomogeneousMedium(const MediumInput& input);
std::optional<MediumPlan> readHeterogeneousMedium(const MediumInput& input);
std::optional<MediumPlan> readNanoVdbMedium(const MediumInput& input);
std::optional<MediumPlan> readPerlinMedium(const MediumInput& input);
std::optional<MediumPlan> readAnalyticMedium(const MediumInput& input);
std::optional<MediumPlan> readTextureMedium(const MediumInput& input);

}  // namespace pbrtmedia
