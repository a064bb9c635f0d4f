// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>

#include "base/vec.h"

namespace pbrtmedia {

/// Directions in which the media around a point are looked for: spread over the sphere and parallel to
/// nothing that scenes are made of. Not normalised.
inline constexpr std::array<Vector3f, 7> kProbeDirections{{{0.3061f, 0.8713f, 0.3836f},
                                                           {-0.7393f, 0.2371f, 0.6302f},
                                                           {0.8219f, -0.3137f, 0.4755f},
                                                           {-0.2693f, -0.8419f, 0.4676f},
                                                           {-0.5839f, 0.6551f, -0.4795f},
                                                           {0.6317f, 0.2939f, -0.7173f},
                                                           {-0.1741f, -0.5171f, -0.8380f}}};

}  // namespace pbrtmedia
