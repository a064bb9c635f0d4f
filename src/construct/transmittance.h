// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "scene/param_reader.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// Reads `"string transmittance"` with the parameters of the estimator it names, and `"string law"` with
/// those of the law, from a medium. Nothing: the choice is the medium's ("auto", or no name). Parameters of
/// ratio tracking without a name mean it. Under a law that ratio tracking does not serve, "auto" is an
/// estimator that does; `walksPieces`: whether voxels can be walked. Errors name the estimators, laws or
/// words that would have been right; a biased estimator is worth a warning.
std::optional<AnyEstimator> readTransmittance(ParamReader& in, bool walksPieces);

}  // namespace pbrtmedia
