// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "textures/mapping2d.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Values at the corners (s, t) of the unit square.
template <class T>
struct BilerpParams {
  T v00{0.0f}, v01{1.0f}, v10{0.0f}, v11{1.0f};  ///< vST
};

/// Bilinear in (s, t), extrapolated outside the unit square.
template <class T>
class BilerpTexture final : public Texture<T> {
 public:
  BilerpTexture(const Mapping2d& mapping, const BilerpParams<T>& params)
      : mapping_(mapping), params_(params) {}
  T evaluate(const SurfaceInteraction& si) const override {
    const auto [s, t] = mapPoint(mapping_, si).st;
    return (1 - s) * (1 - t) * params_.v00 + (1 - s) * t * params_.v01 + s * (1 - t) * params_.v10 +
           s * t * params_.v11;
  }

 private:
  Mapping2d mapping_;
  BilerpParams<T> params_;
};

}  // namespace pbrtmedia
