// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/ray.h"
#include "render/integrator.h"
#include "render/sample_context.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// An integrator that estimates the radiance along camera rays, each by itself; all of them render in one
/// loop over tiles of pixels.
class SamplingIntegrator : public Integrator {
 public:
  /// `ray`: world space, unit direction, differentials already scaled by 1/sqrt(samples per pixel).
  /// Thread-safe.
  virtual Rgb radiance(const RayDifferential& ray, SampleContext& context) const = 0;
  /// Whether `radiance` puts something into SampleContext::splats: of a light path for each camera sample,
  /// what it brings to the image wherever it hits. A pixel is the mean of what camera rays bring plus the
  /// mean over as many splats as there are samples to a pixel of the whole image.
  virtual bool makesSplats() const { return false; }

  /// What every sample can tell, and `layersOfRays`.
  LayerMask layers() const final;
  /// Those that `radiance` sets in SampleContext::layers when they are wanted, without any effect on what it
  /// answers or draws.
  virtual LayerMask layersOfRays() const { return {}; }

  RenderResult render(const Camera& camera, const Sampler& sampler, Film& film,
                      const RenderOptions& options) const final;

 protected:
  using Integrator::Integrator;
};

}  // namespace pbrtmedia
