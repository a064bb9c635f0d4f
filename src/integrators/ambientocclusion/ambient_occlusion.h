// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "render/sampling_integrator.h"
#include "world/scene.h"

namespace pbrtmedia {

/// Parameters of `ambientocclusion` (scene-language reference 11.1).
struct AmbientOcclusionParams {
  bool cosineSampling = true;  ///< directions by the cosine; false: uniform over the hemisphere
  int samples = 64;            ///< directions at each surface point, >= 1
};

/// Integrator `ambientocclusion`: how open the first surface with a material is, the integral of the cosine
/// over the directions of its viewed side that reach infinity: pi where nothing is in the way, as in PBRT-v3.
/// Sides are judged by the geometric normal. Materials, lights and media do not matter; surfaces without
/// material are neither seen nor in the way, and shadowalpha applies. Unbiased.
class AmbientOcclusionIntegrator final : public SamplingIntegrator {
 public:
  AmbientOcclusionIntegrator(const Scene& scene, const AmbientOcclusionParams& params)
      : SamplingIntegrator(scene), params_(params) {}
  std::string_view typeName() const override { return "ambientocclusion"; }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override;

 private:
  /// The estimate at a surface point.
  float openness(const SceneHit& hit, const SurfaceInteraction& si, float time, SampleContext& context) const;

  AmbientOcclusionParams params_;
};

}  // namespace pbrtmedia
