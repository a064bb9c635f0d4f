// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>

#include "textures/mapping2d.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// The texture coordinates as a colour: (frac s, frac t, 0).
class UvTexture final : public RgbTexture {
 public:
  explicit UvTexture(const Mapping2d& mapping) : mapping_(mapping) {}
  Rgb evaluate(const SurfaceInteraction& si) const override {
    const auto [s, t] = mapPoint(mapping_, si).st;
    return {s - std::floor(s), t - std::floor(t), 0};
  }

 private:
  Mapping2d mapping_;
};

}  // namespace pbrtmedia
