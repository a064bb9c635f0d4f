// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/vol_path.h"

#include <glog/logging.h>

#include "integrators/path/path_tracer.h"

namespace pbrtmedia {

VolPathIntegrator::VolPathIntegrator(const Scene& scene, const PathParams& params,
                                     std::unique_ptr<const LightSelector> selector, CameraMedium cameraMedium)
    : SamplingIntegrator(scene),
      params_(params),
      selector_(std::move(selector)),
      cameraMedium_(std::move(cameraMedium)),
      tracker_(scene, cameraMedium_.given()),
      positionLights_(scene.lightsWithMedia()),
      hasMedia_(scene.hasMediumBoundaries() || !cameraMedium_.state().isVacuum()),
      mediaEmit_(scene.hasEmissiveMedia() || MediaTracker::emits(cameraMedium_.state())) {
  CHECK(selector_ || scene.lightsWithMedia().empty()) << "lights need a selector";
}
VolPathIntegrator::~VolPathIntegrator() = default;

Rgb VolPathIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  // Without media and shadowalpha the yes/no occlusion query answers the same and is faster.
  const MediaTracker* const media = hasMedia_ || scene().hasShadowAlpha() ? &tracker_ : nullptr;
  const bool picksDistances = hasMedia_ && !positionLights_.isEmpty() &&
                              params_.mediumLightSampling != MediumLightSampling::Collision;
  const PathSetup setup{scene(),         params_, scene().lightsWithMedia(),
                        selector_.get(), media,   picksDistances ? &positionLights_ : nullptr,
                        mediaEmit_};
  return PathTracer(setup, ray, cameraMedium_.stateFor(ray, scene(), tracker_, context.counters), context)
      .trace();
}

}  // namespace pbrtmedia
