// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>

#include "textures/mapping3d.h"
#include "textures/noise.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Waves whose height follows the wind: |fbm(p/10; 3 octaves)| · fbm(p; 6 octaves), roughness 1/2. T is float
/// or Rgb (grey).
template <class T>
class WindyTexture final : public Texture<T> {
 public:
  explicit WindyTexture(const Mapping3d& mapping) : mapping_(mapping) {}
  T evaluate(const SurfaceInteraction& si) const override {
    const auto [p, dpdx, dpdy] = mapping_(si);
    const float strength = fbm(0.1f * p, 0.1f * dpdx, 0.1f * dpdy, {.octaves = 3, .roughness = 0.5f});
    const float height = fbm(p, dpdx, dpdy, {.octaves = 6, .roughness = 0.5f});
    return T(std::abs(strength) * height);
  }

 private:
  Mapping3d mapping_;
};

}  // namespace pbrtmedia
