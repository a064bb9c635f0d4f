// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// The largest absolute value of the channels: what roulette goes by, as throughputs may be negative.
inline float largestChannel(Rgb c) { return std::max(std::abs(c.max()), std::abs(c.min())); }

}  // namespace pbrtmedia
