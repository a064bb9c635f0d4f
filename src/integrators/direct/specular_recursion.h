// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "integrators/path/path_samples.h"
#include "lights/light.h"
#include "materials/bsdf.h"
#include "render/ray_layers.h"
#include "render/sample_context.h"
#include "world/scene.h"
#include "world/visibility.h"

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
/// ignored and surfaces without material are passed; where they emit they are not seen, as in PBRT-v3.
///
/// Recursion is a list of what is still open, so any `maxDepth` will do. From `kExactLevels` on a chain of
/// rays takes no memory, and rays too dim for a float to hold are not followed. Two rays at each of many
/// surfaces are still 2^depth.
class SpecularRecursion {
 public:
  /// Reflected radiance toward si.wo from direct light.
  using Lighting = std::function<Rgb(const ShadedPoint&, PathSamples&)>;
  SpecularRecursion(const Scene& scene, int maxDepth, const Lighting& lighting, SampleContext& context)
      : scene_(scene),
        maxDepth_(maxDepth),
        lighting_(lighting),
        context_(context),
        samples_(context.sampler, context.rng) {}
  /// Once: it also tells the layers that are wanted.
  Rgb radiance(const RayDifferential& cameraRay);

  /// Up to this level sums and products are rounded in the order in which a recursive function makes them,
  /// and random numbers are drawn in its order. (Levels cost some kilobytes each, and no image needs more.)
  static constexpr int kExactLevels = 1000;

 private:
  /// A ray to follow.
  struct Next {
    RayDifferential ray;
    PrimitiveId start;
    int level;
    Rgb factor, throughput;  ///< of what it finds: at its vertex, and from the camera on
  };
  /// A surface point that specular rays leave.
  struct Vertex {
    ShadedPoint point;
    RayDifferential ray;  ///< by which it was found
    int level;
    Rgb throughput;
  };
  /// A vertex whose radiance is `sum`, plus `factor` times that of the ray being followed, plus that of one
  /// more ray: of `vertex`, or `rest`.
  struct Open {
    Rgb sum, factor;
    std::unique_ptr<Vertex> vertex;
    std::unique_ptr<Next> rest;
  };
  Rgb evaluate(const RayDifferential& cameraRay);
  void tell(const Next& at, Rgb radiance, int scatterings) const;
  void tellSurface(const ShadedPoint& point) const;
  Rgb visit(const Next& at, std::unique_ptr<Vertex>& vertex);
  std::optional<Next> descend(Rgb value, std::unique_ptr<Vertex> vertex, std::vector<Open>& open);
  std::optional<Next> follow(const Vertex& from, BsdfFlags side);

  const Scene& scene_;
  int maxDepth_;
  const Lighting& lighting_;
  SampleContext& context_;
  PathSamples samples_;
  RayLayers* layers_ = nullptr;  ///< null: nobody wants to know
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
