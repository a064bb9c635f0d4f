// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "freeflight/any_sampler.h"
#include "media/medium_params.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// What every medium with a density field has: coefficients that its density scales, and its ways of
/// tracking.
struct FieldMediumParams : MediumParams {
  AnyEstimator estimator = RatioTracking{.rouletteThreshold = 0.1};
  AnySampler sampler;
};

}  // namespace pbrtmedia
