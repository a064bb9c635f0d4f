// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/rng.h"
#include "transmittance/estimate.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia::test {

/// One estimate from independent random numbers.
template <class Estimator, class Line, std::size_t N>
Estimate<N> runEstimator(const Estimator& estimator, const Line& line, const Channels<N>& sigmaT, Rng& rng) {
  SampleStream stream(rng);
  return estimator(line, sigmaT, stream);
}

}  // namespace pbrtmedia::test
