// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

namespace pbrtmedia {

/// Where a stretch takes a light sample.
struct StretchSample {
  std::size_t light;  ///< of the table of lights
  double t;           ///< on the ray
  double pdf;         ///< of this light and this distance together, per length; > 0
};

}  // namespace pbrtmedia
