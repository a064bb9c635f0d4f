// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/traits.h"

namespace pbrtmedia {

std::string_view nameOf(EstimatorTraits::Bias bias) {
  constexpr std::string_view kNames[] = {"unbiased", "consistent", "biased"};
  return kNames[static_cast<int>(bias)];
}
std::string_view nameOf(EstimatorTraits::Control control) {
  constexpr std::string_view kNames[] = {"none", "cost only", "any positive", "bounding"};
  return kNames[static_cast<int>(control)];
}

}  // namespace pbrtmedia
