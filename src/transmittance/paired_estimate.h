// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "transmittance/estimate.h"

namespace pbrtmedia {

/// An Estimate that knows its own noise, from two halves of it that are independent and alike. `spread`
/// changes its sign when they change places, so its mean is 0; if the halves' optical depths are normal, its
/// mean square is the variance of `value`, and value² - spread² an unbiased estimate of T². Value and spread
/// are the real and the imaginary part of one complex number: of several segments in a row the product of
/// these has the same moments. Peters 2025.
template <std::size_t N>
struct PairedEstimate {
  Channels<N> value = filled<N>(1);   ///< what the estimator answers
  Channels<N> spread = filled<N>(0);  ///< dimensionless, any sign
  LookupTally tally;
};

}  // namespace pbrtmedia
