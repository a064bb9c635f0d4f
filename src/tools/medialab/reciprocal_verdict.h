// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "fields/canonical_line.h"
#include "reciprocal/reciprocal_traits.h"
#include "tools/medialab/isolated.h"
#include "tools/medialab/verdict.h"

namespace pbrtmedia {

/// What is known of a line beforehand that estimators of 1/F are tried on.
struct ReciprocalSetting {
  double exact = 1;                  ///< 1/F; infinite where F is 0
  double controlOverF = 1;           ///< alpha / F; infinite, too
  bool isEmptyUnderControl = false;  ///< the density is 0, but not the control
  bool isBounding = true;            ///< the control is a bound
  bool isBlind = false;              ///< a bound of 0 hides density
  bool isPositive = true;            ///< the density, everywhere
  double absolute = 0;               ///< E|1 - density / control| at points spread by the control
  double square = 0;                 ///< E[(1 - density / control)^2]
};
/// `absolute` and `square` by quadrature; 0 under no control.
ReciprocalSetting reciprocalSettingOf(const CanonicalLine& line, double sigmaT);

/// Compares what happened with what the traits promise, as `judge` for transmittance does. Where F is 0 only
/// infinity is right, and of what is outside of an estimator's domain nothing is asked.
StressVerdict judgeReciprocal(const ReciprocalTraits& traits, const ReciprocalSetting& setting,
                              const IsolatedResult& result);

}  // namespace pbrtmedia
