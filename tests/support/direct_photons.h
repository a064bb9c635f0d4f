// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "base/hash.h"
#include "integrators/sppm/photon_gather.h"
#include "integrators/sppm/photon_tracer.h"
#include "lighting/light_strategy.h"
#include "samplers/halton.h"
#include "support/scene_kit.h"

namespace pbrtmedia::test {

/// Photons of one light, direct ones too, and what is gathered of them at one point.
class DirectPhotons {
 public:
  explicit DirectPhotons(const Scene& scene, const Medium* around = nullptr)
      : scene_(scene),
        media_(scene, CameraMedium(scene, kFarAway, 0, around)),
        selector_(makeLightSelector(LightStrategy::Power, scene.illuminants(), scene.bounds())) {}

  PhotonMaps trace(std::uint64_t seed, int paths, int mostScatterings = 0) {
    const PhotonSetup setup{.scene = scene_,
                            .media = media_.hasMedia() ? &media_ : nullptr,
                            .selector = *selector_,
                            .fewestScatterings = 0,
                            .mostScatterings = mostScatterings};
    Photons photons;
    RenderCounters counters;
    HaltonSampler sampler({.pixelSamples = paths, .seed = seed});
    for (int i = 0; i < paths; ++i) {
      sampler.start({0, 0}, i);
      Rng rng(hashCombine(seed, static_cast<std::uint64_t>(i)));
      PhotonTracer(setup, sampler, rng, counters).trace(photons);
    }
    return {PhotonMap<SurfacePhoton>(photons.onSurfaces), PhotonMap<MediumPhoton>(photons.inMedia),
            static_cast<double>(paths)};
  }

 private:
  const Scene& scene_;
  MediaTopology media_;
  std::unique_ptr<const LightSelector> selector_;
};

}  // namespace pbrtmedia::test
