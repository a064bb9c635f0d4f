// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/path.h"

#include <glog/logging.h>

#include "integrators/path/path_tracer.h"

namespace pbrtmedia {

PathIntegrator::PathIntegrator(const Scene& scene, const PathParams& params,
                               std::unique_ptr<const LightSelector> selector)
    : SamplingIntegrator(scene), params_(params), selector_(std::move(selector)) {
  CHECK(selector_ || scene.lights().empty()) << "lights need a selector";
}
PathIntegrator::~PathIntegrator() = default;

LayerMask PathIntegrator::layersOfRays() const {
  // Without scattering nobody asks what the camera ray meets.
  return params_.maxDepth > 0 ? RayLayers::ofSurfaces() : RayLayers::ofRadiance(/*rendersMedia=*/false);
}

Rgb PathIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  const PathSetup setup{scene(), params_, scene().lights().size(), selector_.get(), nullptr, nullptr, false};
  return PathTracer(setup, ray, MediumState(), context).trace();
}

}  // namespace pbrtmedia
