// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

#include "base/rng.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"

namespace pbrtmedia {

/// The outcome of a free flight along a line.
template <std::size_t N>
struct FlightSample {
  bool collided = false;
  double t = 0;                       ///< where, when collided
  Channels<N> weight = filled<N>(1);  ///< collided: sigma_t(t) T(t) / pdf(t); passed: T / Pr{pass}
  LookupTally tally;
};

/// Delta (Woodcock) tracking: tentative collisions with the rate of the local majorant, each real with
/// probability sigma_t rho / majorant. Woodcock et al. 1965. Grey media keep weight 1.
///
/// Chromatic media follow the spectral tracking of Kutz et al. 2017, doi:10.1145/3072959.3073665, with the
/// history-aware average: the largest channel's majorant drives the process, and a tentative collision is
/// real with probability A_r / (A_r + A_n), A_r and A_n being the means over the channels of weight times
/// real and of weight times null extinction. As real and null add up to the majorant, the mean weight of the
/// channels stays 1 and no weight exceeds N. Where a density exceeds its bound, null extinction is negative;
/// probabilities then take absolute values and the weights their sign (Misso et al. 2023, weighted delta
/// tracking): unbiased, but with weights beyond N.
///
/// Bias: none. A density known to lie between bounds is compared with them first, so that a collision that is
/// real whatever the density costs no look-up (grey media only).
struct DeltaTracking {
  static constexpr std::string_view kName = "delta";

  template <DensityLine Line, std::size_t N>
  FlightSample<N> operator()(const Line& line, const Channels<N>& sigmaT, Rng& rng) const;
};

}  // namespace pbrtmedia
