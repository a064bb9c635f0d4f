// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

#include "base/rng.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/probe.h"

namespace pbrtmedia {

/// The outcome of a free flight along a line.
template <std::size_t N>
struct FlightSample {
  bool collided = false;
  double s = 0;                       ///< where on the line, when collided
  Channels<N> weight = filled<N>(1);  ///< collided: sigma_t(s) T(s) / pdf(s); passed: T / Pr{pass}
  LookupTally tally;
};

/// Delta (Woodcock) tracking: tentative collisions with the rate of the local majorant, each real with
/// probability sigma_t rho / majorant. Woodcock et al. 1965. Grey media keep weight 1, and a collision that
/// the cell's lower bound already makes real costs no look-up.
///
/// Chromatic media follow the spectral tracking of Kutz et al. 2017, doi:10.1145/3072959.3073665, with the
/// history-aware average: the largest channel's majorant drives the process, and a tentative collision is
/// real with probability A_r / (A_r + A_n), A_r and A_n being the sums over the channels of weight times real
/// and of weight times null extinction. As real and null add up to the majorant, the mean weight of the
/// channels stays 1, so no weight exceeds N.
///
/// Where a density exceeds its bound, null extinction is negative; probabilities then take absolute values
/// and the weights the sign (Misso et al. 2023, weighted delta tracking): unbiased, but with weights beyond
/// N.
///
/// Bias: none, wherever the bounds are positive. Events of probability 0 are never chosen.
struct DeltaTracking {
  static constexpr std::string_view kName = "delta";

  template <DensityLine Line, std::size_t N>
  FlightSample<N> operator()(const Line& line, const Channels<N>& sigmaT, Rng& rng) const {
    FlightSample<N> flight;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return flight;
    Channels<N> share;  // of the largest channel
    for (std::size_t c = 0; c < N; ++c) share[c] = sigmaT[c] / sigmaMax;
    double depth = rng.exponential();  // optical depth of the majorant to the next tentative collision
    line.walk([&](double sEnter, double sExit, const SuperVoxel& bound) {
      if (!(bound.upper > 0)) {
        if constexpr (!Line::kProvenBounds) probeEmpty(line, sEnter, sExit, rng, flight.tally);
        return true;
      }
      const double majorant = sigmaMax * static_cast<double>(bound.upper), inverse = 1 / majorant;
      for (double s = sEnter;;) {
        const double depthToExit = (sExit - s) * majorant;
        if (depth >= depthToExit) {
          depth -= depthToExit;
          return true;
        }
        s += depth * inverse;
        if (isReal(line, s, bound, share, flight, rng)) {
          flight.collided = true;
          flight.s = s;
          return false;
        }
        ++flight.tally.nullCollisions;
        depth = rng.exponential();
      }
    });
    return flight;
  }

 private:
  /// Decides one tentative collision and updates the weights. In units of the largest channel's sigma_t.
  template <DensityLine Line, std::size_t N>
  static bool isReal(const Line& line, double s, const SuperVoxel& bound, const Channels<N>& share,
                     FlightSample<N>& flight, Rng& rng) {
    const double upper = bound.upper, u = rng.uniformDouble();
    if constexpr (N == 1) {
      if (u * upper < bound.lower) return true;
    }
    const double density = line.density(s);
    ++flight.tally.lookups;
    if (density > upper) flight.tally.noteViolation(density, upper);
    if constexpr (N == 1) {
      if (density <= upper) return u * upper < density;
    }
    // A sum of 0 is never chosen: u * 0 < 0 is false, and u (A_r + 0) < A_r is true.
    double real = 0, null = 0;
    for (std::size_t c = 0; c < N; ++c) {
      real += std::abs(flight.weight[c]) * share[c] * density;
      null += std::abs(flight.weight[c] * (upper - share[c] * density));
    }
    const bool isChosen = u * (real + null) < real;
    const double scale = (real + null) / (upper * (isChosen ? real : null));
    for (std::size_t c = 0; c < N; ++c) {
      flight.weight[c] *= scale * (isChosen ? share[c] * density : upper - share[c] * density);
    }
    return isChosen;
  }
};

}  // namespace pbrtmedia
