// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "media/phase/phase_params.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// `"string phase"` names one lobe or several, with "phaseweight" for each and "g" for each that is
/// Henyey-Greenstein. Without it: PBRT-v3's Henyey-Greenstein.
std::vector<PhaseLobe> readPhase(ParamReader& in);

}  // namespace pbrtmedia
