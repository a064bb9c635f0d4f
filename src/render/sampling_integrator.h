// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "base/ray.h"
#include "render/integrator.h"
#include "render/sample_context.h"
#include "render/tile_memory.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

class LightSelector;

/// An integrator that estimates the radiance along camera rays, each by itself; all of them render in one
/// loop over tiles of pixels.
class SamplingIntegrator : public Integrator {
 public:
  /// `ray`: world space, unit direction, differentials already scaled by 1/sqrt(samples per pixel).
  /// Thread-safe.
  virtual Rgb radiance(const RayDifferential& ray, SampleContext& context) const = 0;
  /// What `radiance` finds in SampleContext::memory; null: it looks for nothing there. Borrows all.
  virtual std::unique_ptr<TileMemory> tileMemory(const Camera& camera, std::uint64_t seed) const {
    (void)camera, (void)seed;
    return nullptr;
  }
  /// What every sample can tell, and `layersOfRays`.
  LayerMask layers() const final;
  /// Those that `radiance` sets in SampleContext::layers when they are wanted, without any effect on what it
  /// answers or draws.
  virtual LayerMask layersOfRays() const { return {}; }
  /// What chooses lights and may learn from exploratory paths (SampleContext::lightTrials); null: nothing.
  virtual const LightSelector* learner() const { return nullptr; }

  RenderResult render(const Camera& camera, const Sampler& sampler, Film& film,
                      const RenderOptions& options) const final;

 protected:
  using Integrator::Integrator;
};

}  // namespace pbrtmedia
