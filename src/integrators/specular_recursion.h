// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>

#include "integrators/integrator.h"
#include "integrators/path_samples.h"
#include "integrators/scene.h"
#include "integrators/visibility.h"

namespace pbrtmedia {

/// A surface point with its scattering.
struct ShadedPoint {
  SceneHit hit;
  SurfaceInteraction si;
  Bsdf bsdf;
  float time = 0;
};

/// What `whitted` and `directlighting` share: emission, direct light by `lighting`, and recursion over
/// perfect specular reflection and transmission up to `maxDepth` levels, with ray differentials. Media are
/// ignored and surfaces without material are passed.
class SpecularRecursion {
 public:
  /// Reflected radiance toward si.wo from direct light.
  using Lighting = std::function<Rgb(const ShadedPoint&, PathSamples&)>;
  SpecularRecursion(const Scene& scene, int maxDepth, const Lighting& lighting, SampleContext& context)
      : scene_(scene), maxDepth_(maxDepth), lighting_(lighting), context_(context), samples_(context) {}
  Rgb radiance(const RayDifferential& ray, PrimitiveId start, int level);

 private:
  Rgb follow(const ShadedPoint& point, const RayDifferential& ray, BsdfFlags side, int level);

  const Scene& scene_;
  int maxDepth_;
  const Lighting& lighting_;
  SampleContext& context_;
  PathSamples samples_;
};

/// The auxiliary rays of a ray mirrored at, or refracted through, a surface; after Igehy 1999,
/// doi:10.1145/311535.311555, with the derivatives of the shading normal. `eta`: relative index (Bsdf::eta).
RayDifferential mirroredRay(const SurfaceInteraction& si, const RayDifferential& ray, Vector3f wi);
RayDifferential refractedRay(const SurfaceInteraction& si, const RayDifferential& ray, Vector3f wi,
                             float eta);

/// One light seen from a point, light sampling only: f cos L / pdf, before multiple importance sampling.
/// Black when occluded.
struct LitSample {
  Rgb radiance;   ///< of the light sample, black when there is nothing
  Rgb scattered;  ///< f |cos|
  LightSample sample;
};
LitSample sampleLight(const Scene& scene, const ShadedPoint& point, std::size_t light, Point2f u,
                      RenderCounters& counters);

}  // namespace pbrtmedia
