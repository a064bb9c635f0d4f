// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "render/ray_layers.h"
#include "render/sampling_integrator.h"
#include "world/scene.h"

namespace pbrtmedia {

/// Parameters of `whitted` (scene-language reference 11.1).
struct WhittedParams {
  int maxDepth = 5;  ///< levels of specular recursion; 1: none
};

/// Integrator `whitted`: emission, one sample of every light (light sampling only), and recursion over
/// perfect specular reflection and transmission. Ignores media; surfaces without material neither scatter nor
/// block.
class WhittedIntegrator final : public SamplingIntegrator {
 public:
  WhittedIntegrator(const Scene& scene, const WhittedParams& params)
      : SamplingIntegrator(scene), params_(params) {}
  std::string_view typeName() const override { return "whitted"; }
  LayerMask layersOfRays() const override { return RayLayers::ofSurfaces(); }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override;

 private:
  WhittedParams params_;
};

}  // namespace pbrtmedia
