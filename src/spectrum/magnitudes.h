// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Each channel without its sign.
inline Rgb magnitudes(Rgb c) { return {std::abs(c.r), std::abs(c.g), std::abs(c.b)}; }

}  // namespace pbrtmedia
