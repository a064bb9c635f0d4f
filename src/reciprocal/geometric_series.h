// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "base/interruption.h"
#include "transmittance/parts/running_product.h"
#include "transmittance/parts/term_roulette.h"
#include "transmittance/sample_stream.h"

// Unbiased estimates of 1/F from independent unbiased estimates of F or from events of probability F / alpha,
// with nothing known of where they come from: a density along a line, a pdf that is itself an integral, a
// random process that finds a solution or another one. All expand the geometric series about alpha,
//   1/F = 1/alpha sum_j (1 - F/alpha)^j.

namespace pbrtmedia {

/// Prefix sums of the series with the roulette on the size of the terms: W_j = W_{j-1} ratio(), continued
/// with probability min(|W_j|, 1) and then divided by it. `ratio()`: an independent unbiased estimate of 1 -
/// F/alpha. Misso et al. 2022, Eq. (6), with Georgiev et al. 2019, Eq. (30). `isOver()` ends the sum early: a
/// bias.
///
/// The mean exists where E|ratio| < 1, the variance where E[ratio^2] < 1, too. While |ratio| <= 1 all W are 1
/// or -1 and E[sum^2] = (1 + 2 m / (1 - m)) / (1 - E|ratio|), m = E[ratio]: for ratios in [0, 1] the number
/// of trials until a success of probability 1 - m, whatever else their distribution.
template <class Ratio, class IsOver>
double cumulativeReciprocal(double alpha, SampleStream& stream, Ratio&& ratio, IsOver&& isOver) {
  double sum = 1;
  for (RunningProduct weight; !isOver();) {
    leaveIfAbandoned();
    weight.multiply(ratio());
    const double survival = survivalFactor(weight.magnitude(), stream);
    if (!(survival > 0)) break;
    if (survival > 1) weight.multiply(survival);
    addTerm(sum, weight.product());
  }
  return sum / alpha;
}

/// The number of independent trials of success probability F / alpha until the first success, over alpha. Qin
/// et al. 2015; Zeltner et al. 2020. Variance (1 - p) / (p alpha)^2, p = F / alpha. `isOver()` ends the
/// trials early: a bias.
template <class Trial, class IsOver>
double trialsReciprocal(double alpha, Trial&& succeeds, IsOver&& isOver) {
  double trials = 1;
  while (!isOver() && !succeeds()) {
    leaveIfAbandoned();
    ++trials;
  }
  return trials / alpha;
}

}  // namespace pbrtmedia
