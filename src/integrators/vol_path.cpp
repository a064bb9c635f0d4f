// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/vol_path.h"

#include <glog/logging.h>

#include "integrators/path_tracer.h"

namespace pbrtmedia {

VolPathIntegrator::VolPathIntegrator(const Scene& scene, const PathParams& params,
                                     std::unique_ptr<const LightSelector> selector, CameraMedium cameraMedium)
    : scene_(scene),
      params_(params),
      selector_(std::move(selector)),
      cameraMedium_(std::move(cameraMedium)),
      tracker_(scene, cameraMedium_.given()) {
  CHECK(selector_ || scene.lights().empty()) << "lights need a selector";
}
VolPathIntegrator::~VolPathIntegrator() = default;

Rgb VolPathIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  // Without media and shadowalpha the yes/no occlusion query answers the same and is faster.
  const bool hasMedia = scene_.hasMediumBoundaries() || !cameraMedium_.state().isVacuum();
  const MediaTracker* const media = hasMedia || scene_.hasShadowAlpha() ? &tracker_ : nullptr;
  const PathSetup setup{scene_, params_, selector_.get(), media};
  return PathTracer(setup, ray, cameraMedium_.stateFor(ray, scene_, tracker_, context.counters), context)
      .trace();
}

}  // namespace pbrtmedia
