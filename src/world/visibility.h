// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <span>

#include "lights/light.h"
#include "media/paired_transmittance.h"
#include "spectrum/rgb.h"
#include "world/media_walk.h"
#include "world/scatter_point.h"

namespace pbrtmedia {

/// The way from a vertex to a light sample.
struct ShadowRay {
  Ray ray;
  Exclusions exclusions;
  std::uint32_t hider = PrimitiveId::kNone;  ///< Scene::hiderOf the light
  const ScatterPoint* from = nullptr;        ///< its start, if that is a scattering in a medium
};

/// A ray from `p` along `sample.wi` that ends on the light. `start`: the primitives that hold p (t = 0).
/// The emitting primitive itself does not block.
ShadowRay shadowRayTo(const Scene& scene, std::size_t light, const LightSample& sample, Point3f p, float time,
                      const Exclusions& start);

// Walks along shadow rays; `context` is told to count them as such.

/// Radiance that `medium` sends along the shadow ray to its start, from where it is present inside `span`,
/// dimmed by everything on the way: black when a surface with a material is before it. `ray.tMax` is behind
/// the span. Unbiased. `state`: of the start.
Rgb shadowEmission(const MediaWalk::Context& context, const ShadowRay& shadow, const PlacedMedium& medium,
                   Span<double> span, MediumState state, PixelStream random);

/// The same point by point.
struct EmissionOnWay {
  double t = 0;
  Rgb radiance;  ///< a sample of what arrives from there (EmissionSamples)
  Rgb depth;     ///< what the media's controls say of the way there
};
void visitShadowEmission(const MediaWalk::Context& context, const ShadowRay& shadow,
                         const PlacedMedium& medium, Span<double> span, MediumState state, PixelStream random,
                         const std::function<void(const EmissionOnWay&)>& visit);

/// Transmittance of the media along the shadow ray, starting in `state`: black when a surface with a material
/// is in the way, or `shadow.hider`. Boundaries without material are crossed. shadowalpha does not apply
/// (closest hits are searched). `state` is then that of the far end.
Rgb shadowTransmittance(const MediaWalk::Context& context, const ShadowRay& shadow, MediumState& state,
                        PixelStream random);

/// The same, and the optical depth that the media's controls give of the way (MediaStretch::control).
struct ControlledTransmittance {
  Rgb value, controlDepth;
};
ControlledTransmittance controlledShadowTransmittance(const MediaWalk::Context& context,
                                                      const ShadowRay& shadow, MediumState& state,
                                                      PixelStream random);

/// The same with what the media know of its noise: multiplies each of `estimates` by an independent one.
void dimByShadow(const MediaWalk::Context& context, const ShadowRay& shadow, MediumState& state,
                 PixelStream random, std::span<PairedTransmittance> estimates);

}  // namespace pbrtmedia
