// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/animated_transform.h"

namespace pbrtmedia {

/// Throws std::invalid_argument when the transform has no inverse at one of its ends.
void requireInvertible(const AnimatedTransform& worldFromCamera);

/// Throws std::invalid_argument unless the lens radius is >= 0 and finite and, with a lens, the focal
/// distance is > 0. The result is what the cameras compute with: 1 / focalDistance, or 0 without a lens.
double checkedInverseFocalDistance(float lensRadius, float focalDistance);

/// Throws std::invalid_argument unless both times are finite and open <= close.
void requireShutter(float open, float close);

}  // namespace pbrtmedia
