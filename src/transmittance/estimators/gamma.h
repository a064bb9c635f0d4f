// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>
#include <variant>
#include <vector>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/any_exponential_estimator.h"
#include "transmittance/estimate.h"
#include "transmittance/estimate_on.h"
#include "transmittance/law.h"
#include "transmittance/parts/gamma_variate.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// The gamma trick: pink-noise transmittance is the mean of exp(-gamma F) over gamma ~ Gamma(shape 1 / C^2,
/// scale C^2), so any estimator of exponential transmittance, asked with the extinction scaled by a random
/// gamma, estimates it. Bitterli et al. 2018, doi:10.1145/3272127.3275103; Misso et al. 2022, section 5.2.
/// One gamma for all channels.
///
/// Bias: that of the base. Range: that of the base. Variance: the mean of the base's over gamma plus that of
/// exp(-gamma F), g(2 F) - g(F)^2; with ratio tracking E[T^2] = (1 + C^2 (2 F - integral of mu^2 /
/// majorant))^(-1/C^2), infinite where the bracket is <= 0, which takes a control below mu / 2. Cost: the
/// base's, averaged over gamma; unbounded, as gamma is.
struct Gamma {
  static constexpr std::string_view kName = "gamma";

  PinkNoiseLaw law = {};
  AnyExponentialEstimator base = {};  ///< under the exponential law

  EstimatorTraits traits() const;

  /// `base`, a keyword, then the parameters of the base (parameters.h).
  std::vector<ParameterDescription> describe() const;
  /// Naming a base resets its parameters.
  AssignResult assign(std::string_view name, const ParameterValue& value);

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    const double gamma = drawScale(stream);
    Channels<N> scaled;
    for (std::size_t c = 0; c < N; ++c) scaled[c] = sigmaT[c] * gamma;
    return std::visit([&](const auto& estimator) { return estimateOn(estimator, line, scaled, stream); },
                      base);
  }

 private:
  /// C so small that gamma is 1 within rounding, and 1 / C^2 may be infinite.
  static constexpr double kNoCorrelation = 1e-9;

  double drawScale(SampleStream& stream) const {
    if (law.correlation < kNoCorrelation) return 1;
    return gammaVariate(1 / (law.correlation * law.correlation), stream);
  }
};

}  // namespace pbrtmedia
