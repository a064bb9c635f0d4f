// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>

#include "lighting/light_selector.h"
#include "render/sampling_integrator.h"
#include "singlescattering/medium_light_sampling.h"
#include "world/scene.h"

namespace pbrtmedia {

/// How a path shares the work among channels that a medium treats differently.
enum class ChannelSampling {
  Auto,    ///< Shared, but Split where extinctions differ widely
  Shared,  ///< one path for all channels, by multiple importance sampling over them
  Split    ///< a path for each from where it first meets such a medium
};

/// What the weights between light samples and scattered directions know of the media on the way
/// (TransmittanceShares).
enum class MisTransmittance {
  None,         ///< nothing
  Bounds,       ///< what the bounds of media say of their optical depth, without look-ups
  Independent,  ///< estimates of the transmittance, others than those they multiply
  Joint         ///< the same estimates
};

/// Parameters that `path` and `volpath` share (scene-language reference 11.1, 11.2).
struct PathParams {
  int maxDepth = 5;       ///< scattering vertices of a path; 0: visible emission only
  float rrThreshold = 1;  ///< roulette is played on throughputs below it; 0: never
  std::string lightSampleStrategy =
      "tree";  ///< a word of lightStrategyOfName; for whoever makes the selector
  MediumLightSampling mediumLightSampling = {};                ///< `volpath` only
  ChannelSampling channelSampling = ChannelSampling::Auto;     ///< `volpath` only
  MisTransmittance misTransmittance = MisTransmittance::None;  ///< `volpath` only
};

/// Integrator `path`: unidirectional path tracing over surfaces, next-event estimation and multiple
/// importance sampling. Ignores media; surfaces without material neither scatter nor block. Unbiased.
class PathIntegrator final : public SamplingIntegrator {
 public:
  /// `selector` may be null when the scene has no lights.
  PathIntegrator(const Scene& scene, const PathParams& params, std::unique_ptr<const LightSelector> selector);
  ~PathIntegrator() override;
  std::string_view typeName() const override { return "path"; }
  LayerMask layersOfRays() const override;
  const LightSelector* learner() const override { return selector_.get(); }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override;

 private:
  PathParams params_;
  std::unique_ptr<const LightSelector> selector_;
};

}  // namespace pbrtmedia
