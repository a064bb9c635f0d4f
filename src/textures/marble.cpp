// SPDX-License-Identifier: BSD-2-Clause
#include "textures/marble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pbrtmedia {

Rgb marbleColor(float t) {
  constexpr Rgb kGrey{0.58f, 0.58f, 0.6f};
  constexpr std::array<Rgb, 9> kColors{kGrey,
                                       kGrey,
                                       kGrey,
                                       Rgb{0.5f, 0.5f, 0.5f},
                                       Rgb{0.6f, 0.59f, 0.58f},
                                       kGrey,
                                       kGrey,
                                       Rgb{0.2f, 0.2f, 0.33f},
                                       kGrey};
  // Only two segments are ever used; the second runs far past its end (scene-language reference 14.4).
  const std::size_t first = 6 * t >= 1 ? 1 : 0;
  const float x = 6 * t - static_cast<float>(first), y = 1 - x;
  const Rgb curve = y * y * y * kColors[first] + 3 * x * y * y * kColors[first + 1] +
                    3 * x * x * y * kColors[first + 2] + x * x * x * kColors[first + 3];
  return 1.5f * curve;
}

Rgb MarbleTexture::evaluate(const SurfaceInteraction& si) const {
  const auto [p, dpdx, dpdy] = mapping_(si);
  const float scale = params_.scale;
  const Point3f q = scale * p;
  const float layer = q.y + params_.variation * fbm(q, scale * dpdx, scale * dpdy, params_.fractal);
  return marbleColor(0.5f + 0.5f * std::sin(layer));
}

}  // namespace pbrtmedia
