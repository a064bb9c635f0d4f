// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>

#include "freeflight/any_flight.h"
#include "media/bounds_params.h"
#include "media/emission/emission_pattern.h"
#include "media/medium_params.h"
#include "transmittance/any_estimator.h"
#include "transmittance/sampling_pattern.h"

namespace pbrtmedia {

/// What every medium with a density field has: coefficients that its density scales, and its ways of
/// tracking.
struct FieldMediumParams : MediumParams {
  /// What `le` is multiplied with from place to place; null: nothing.
  std::shared_ptr<const EmissionPattern> emissionPattern;
  std::optional<AnyEstimator> estimator;  ///< none: chosen by `chooseEstimator`
  AnyFlight flights;
  PatternKind pattern = PatternKind::Independent;  ///< across the estimates of one pixel
  BoundsParams bounds;
};

}  // namespace pbrtmedia
