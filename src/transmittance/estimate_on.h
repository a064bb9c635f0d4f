// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <stdexcept>

#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/paired_estimate.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// An estimate on any line. An estimator whose traits say needsPieces must not be asked on a line without:
/// std::logic_error.
template <class Estimator, DensityLine Line, std::size_t N>
Estimate<N> estimateOn(const Estimator& estimator, const Line& line, const Channels<N>& sigmaT,
                       SampleStream& stream) {
  if constexpr (requires { estimator(line, sigmaT, stream); }) {
    return estimator(line, sigmaT, stream);
  } else {
    throw std::logic_error("this estimator needs a line in cubic pieces");
  }
}

/// The same with its spread. An estimator whose traits do not say tellsSpread must not be asked:
/// std::logic_error.
template <class Estimator, DensityLine Line, std::size_t N>
PairedEstimate<N> pairedOn(const Estimator& estimator, const Line& line, const Channels<N>& sigmaT,
                           SampleStream& stream) {
  if constexpr (requires { estimator.paired(line, sigmaT, stream); }) {
    return estimator.paired(line, sigmaT, stream);
  } else {
    throw std::logic_error("this estimator does not tell its spread");
  }
}

}  // namespace pbrtmedia
