// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "transmittance/estimate.h"

namespace pbrtmedia {

/// The outcome of a free flight along a line.
template <std::size_t N>
struct FlightSample {
  bool collided = false;
  double s = 0;                       ///< where on the line, when collided
  Channels<N> weight = filled<N>(1);  ///< collided: sigma_t(s) T(s) / pdf(s); passed: T / Pr{pass}
  LookupTally tally = {};
};

}  // namespace pbrtmedia
