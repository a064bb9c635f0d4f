// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "textures/mapping3d.h"
#include "textures/noise.h"
#include "textures/texture.h"

namespace pbrtmedia {

struct MarbleParams {
  FractalParams fractal;
  float scale = 1;         ///< of the solid point
  float variation = 0.2f;  ///< how far the fractal disturbs the layers
};

/// Layers along y, disturbed by fractal noise, coloured by a Bézier curve that PBRT-v3 extrapolates
/// (scene-language reference 14.4).
class MarbleTexture final : public RgbTexture {
 public:
  MarbleTexture(const Mapping3d& mapping, const MarbleParams& params) : mapping_(mapping), params_(params) {}
  Rgb evaluate(const SurfaceInteraction& si) const override;

 private:
  Mapping3d mapping_;
  MarbleParams params_;
};

/// The marble colour at t in [0, 1].
Rgb marbleColor(float t);

}  // namespace pbrtmedia
