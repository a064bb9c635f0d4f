// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/vol_path.h"

#include <glog/logging.h>

#include "integrators/path/path_memory.h"
#include "integrators/path/path_tracer.h"

namespace pbrtmedia {

VolPathIntegrator::VolPathIntegrator(const Scene& scene, const PathParams& params,
                                     std::unique_ptr<const LightSelector> selector, CameraMedium cameraMedium)
    : SamplingIntegrator(scene),
      params_(params),
      selector_(std::move(selector)),
      media_(scene, std::move(cameraMedium)),
      singleScattering_(scene.lights(), selector_.get(), params.mediumLightSampling) {
  CHECK(selector_ || scene.illuminants().empty()) << "lights need a selector";
}
VolPathIntegrator::~VolPathIntegrator() = default;

std::unique_ptr<TileMemory> VolPathIntegrator::tileMemory(const Camera& camera, std::uint64_t seed) const {
  if (!media_.hasMedia() || !singleScattering_.explores()) return nullptr;
  return std::make_unique<PathMemory>(media_, camera, seed);
}

LayerMask VolPathIntegrator::layersOfRays() const {
  // Without scattering nobody asks what the camera ray meets.
  return params_.maxDepth > 0 ? RayLayers::ofMedia() : RayLayers::ofRadiance(/*rendersMedia=*/true);
}

Rgb VolPathIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  // Without media and shadowalpha the yes/no occlusion query answers the same and is faster.
  const bool hasMedia = media_.hasMedia();
  const PathSetup setup{scene(),
                        params_,
                        scene().illuminants().size(),
                        selector_.get(),
                        hasMedia || scene().hasShadowAlpha() ? &media_ : nullptr,
                        hasMedia ? &singleScattering_ : nullptr,
                        media_.hasEmission(),
                        context.memory ? &static_cast<PathMemory*>(context.memory)->explorers() : nullptr};
  return PathTracer(setup, ray, media_.stateOf(ray, context.counters), context).trace();
}

}  // namespace pbrtmedia
