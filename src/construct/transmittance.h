// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "scene/param_reader.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// Reads `"string transmittance"` with the parameters of the estimator it names, and `"string law"` with
/// those of the law, from a medium. `fallback`: the estimator of a medium that names none. Errors name the
/// estimators, laws or words that would have been right; a biased estimator is worth a warning.
AnyEstimator readTransmittance(ParamReader& in, AnyEstimator fallback);

}  // namespace pbrtmedia
