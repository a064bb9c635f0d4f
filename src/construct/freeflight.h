// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "freeflight/any_sampler.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// Reads `"string freeflight"` with the parameters of the sampler it names, from a medium. `fallback`: the
/// sampler of a medium that names none. Errors name the samplers or words that would have been right; a
/// biased sampler is worth a warning.
AnySampler readFreeFlight(ParamReader& in, AnySampler fallback);

}  // namespace pbrtmedia
