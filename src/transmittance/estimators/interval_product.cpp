// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/interval_product.h"

#include "transmittance/parts/base_estimator.h"

namespace pbrtmedia {

EstimatorTraits IntervalProduct::traits() const {
  EstimatorTraits traits = traitsOf(base);
  traits.summary =
      "the product of an estimator's independent estimates of the intervals between super-voxel borders";
  traits.source = "Misso et al. 2023, figure 9, as in the renderer published with it";
  traits.useWhen = "images of code that works so are to be made again";
  traits.tellsSpread = false;
  traits.laws = LawSet::exponential();
  return traits;
}

std::vector<ParameterDescription> IntervalProduct::describe() const { return describeBase(base); }

AssignResult IntervalProduct::assign(std::string_view name, const ParameterValue& value) {
  return assignBase(base, name, value);
}

}  // namespace pbrtmedia
