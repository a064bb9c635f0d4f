// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/gamma.h"

#include "transmittance/parts/base_estimator.h"

namespace pbrtmedia {

EstimatorTraits Gamma::traits() const {
  const EstimatorTraits of = traitsOf(base);
  // Estimates in [0, 1] have a finite variance whatever gamma is. Those beyond may grow faster with gamma
  // than its density falls.
  const bool finite = of.finiteVariance && !of.mayLeaveUnitInterval;
  return {
      .summary = "an exponential estimator in a medium scaled by a random factor of the gamma distribution",
      .source = "Bitterli et al. 2018; Misso et al. 2022, section 5.2",
      .useWhen = "the law is pink noise and an estimator for the exponential law does well",
      .bias = of.bias,
      .biasNote = of.biasNote,
      .mayLeaveUnitInterval = of.mayLeaveUnitInterval,
      .control = of.control,
      .finiteVariance = finite,
      .finiteVarianceUnbounded =
          finite && of.finiteVarianceUnbounded && of.control == EstimatorTraits::Control::Unused,
      .boundedCost = of.boundedCost,
      .needsPieces = of.needsPieces,
      .laws = LawSet::pinkNoise()};
}

std::vector<ParameterDescription> Gamma::describe() const { return describeBase(base); }

AssignResult Gamma::assign(std::string_view name, const ParameterValue& value) {
  return assignBase(base, name, value);
}

}  // namespace pbrtmedia
