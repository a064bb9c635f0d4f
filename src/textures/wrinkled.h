// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "textures/mapping3d.h"
#include "textures/noise.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Turbulence, >= 0 for roughness >= 0. T is float or Rgb (grey).
template <class T>
class WrinkledTexture final : public Texture<T> {
 public:
  WrinkledTexture(const Mapping3d& mapping, const FractalParams& params)
      : mapping_(mapping), params_(params) {}
  T evaluate(const SurfaceInteraction& si) const override {
    const auto [p, dpdx, dpdy] = mapping_(si);
    return T(turbulence(p, dpdx, dpdy, params_));
  }

 private:
  Mapping3d mapping_;
  FractalParams params_;
};

}  // namespace pbrtmedia
