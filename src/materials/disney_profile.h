// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/math.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// R (e^(-r/d) + e^(-r/3d)) / (8 π d r): Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated
/// Subsurface Scattering", Eq. (5). A quarter of its albedo R is the first part, which is sampled as such.
struct DisneyProfile {
  Rgb albedo;
  Rgb distance;  ///< d, world length; 0: nothing is scattered

  Rgb radial(float r) const { return albedo * Rgb(pdfRadius(0, r), pdfRadius(1, r), pdfRadius(2, r)); }
  float sampleRadius(std::size_t channel, float u) const {
    const float d = distance[channel];
    if (!(d > 0)) return -1;
    constexpr float kShare = 0.25f;
    if (u < kShare) return -d * std::log1p(-std::min(u / kShare, kOneMinusEpsilon));
    return -3 * d * std::log1p(-std::min((u - kShare) / (1 - kShare), kOneMinusEpsilon));
  }
  float pdfRadius(std::size_t channel, float r) const {
    const float d = distance[channel];
    if (!(d > 0)) return 0;
    const float away = std::max(r, 1e-6f * d);  // no singularity at the point of entry itself
    return (std::exp(-away / d) + std::exp(-away / (3 * d))) / (8 * kPi * d * away);
  }
};

}  // namespace pbrtmedia
