// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "integrators/path/path.h"
#include "lighting/light_selector.h"
#include "render/sampling_integrator.h"
#include "singlescattering/single_scattering.h"
#include "world/media_topology.h"

namespace pbrtmedia {

/// Integrator `volpath`: path tracing over surfaces and media. Scattering in a medium counts as a bounce,
/// crossing a boundary without material does not. Media that emit are found by the distances at which paths
/// look for emission and, being lights, by light samples. Unbiased.
class VolPathIntegrator final : public SamplingIntegrator {
 public:
  /// `selector` is over Scene::illuminants(); may be null when that is empty.
  VolPathIntegrator(const Scene& scene, const PathParams& params,
                    std::unique_ptr<const LightSelector> selector, CameraMedium cameraMedium);
  ~VolPathIntegrator() override;
  std::string_view typeName() const override { return "volpath"; }
  std::unique_ptr<TileMemory> tileMemory(const Camera& camera, std::uint64_t seed) const override;
  LayerMask layersOfRays() const override;
  const LightSelector* learner() const override { return selector_.get(); }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override;
  const CameraMedium& cameraMedium() const { return media_.camera(); }

 private:
  PathParams params_;
  std::unique_ptr<const LightSelector> selector_;
  MediaTopology media_;
  SingleScattering singleScattering_;
};

}  // namespace pbrtmedia
