// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "tools/medialab_estimator.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// What a LabEstimator holds; for the files that compile estimators.
struct LabEstimator::Held {
  AnyEstimator estimator;
};

}  // namespace pbrtmedia
