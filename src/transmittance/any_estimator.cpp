// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/any_estimator.h"

#include "transmittance/variant_names.h"

namespace pbrtmedia {

std::string_view nameOf(const AnyEstimator& estimator) { return alternativeName(estimator); }
std::optional<AnyEstimator> findEstimator(std::string_view name) {
  return findAlternative<AnyEstimator>(name);
}
std::vector<std::string_view> estimatorNames() { return alternativeNames<AnyEstimator>(); }

}  // namespace pbrtmedia
