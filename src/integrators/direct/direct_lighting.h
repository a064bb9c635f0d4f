// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "render/ray_layers.h"
#include "render/sampling_integrator.h"
#include "world/scene.h"

namespace pbrtmedia {

/// Parameters of `directlighting` (scene-language reference 11.1).
struct DirectLightingParams {
  enum class Strategy {
    All,  ///< every light, with its own number of samples
    One   ///< one light, picked uniformly
  } strategy = Strategy::All;
  int maxDepth = 5;  ///< levels of specular recursion; 1: none
};

/// Integrator `directlighting`: emission, direct light by multiple importance sampling, and recursion over
/// perfect specular reflection and transmission. Ignores media; surfaces without material neither scatter nor
/// block.
class DirectLightingIntegrator final : public SamplingIntegrator {
 public:
  DirectLightingIntegrator(const Scene& scene, const DirectLightingParams& params)
      : SamplingIntegrator(scene), params_(params) {}
  std::string_view typeName() const override { return "directlighting"; }
  LayerMask layersOfRays() const override { return RayLayers::ofSurfaces(); }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override;

 private:
  DirectLightingParams params_;
};

}  // namespace pbrtmedia
