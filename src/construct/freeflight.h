// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "freeflight/any_flight.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// Reads `"string freeflight"` with the parameters of the sampler it names, from a medium. `law`: that of its
/// transmittance. "auto" is the default sampler, than which no other was clearly faster at equal variance in
/// any scene measured, and under a law that it does not serve regular tracking, if it `walksPieces`. Errors
/// name the samplers or words that would have been right; a biased sampler is worth a warning. `scatters`:
/// else no flight is flown and any sampler will do.
AnyFlight readFreeFlight(ParamReader& in, const AnyLaw& law, bool walksPieces, bool scatters);

}  // namespace pbrtmedia
