// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "spectrum/rgb.h"
#include "transmittance/estimate.h"

namespace pbrtmedia {

/// Colours as the channels of estimators and free flights, and back. One channel stands for three alike.
inline Channels<3> channelsOf(Rgb c) { return {c.r, c.g, c.b}; }

template <std::size_t N>
Rgb toRgb(const Channels<N>& c) {
  if constexpr (N == 1) {
    return Rgb(static_cast<float>(c[0]));
  } else {
    return Rgb(static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]));
  }
}

}  // namespace pbrtmedia
