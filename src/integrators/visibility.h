// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "integrators/media_tracker.h"

namespace pbrtmedia {

/// The way from a vertex to a light sample.
struct ShadowRay {
  Ray ray;
  Exclusions exclusions;
};

/// A ray from `p` along `sample.wi` that ends on the light. `start`: primitive that holds p (invalid: none).
/// `target`: the emitting primitive, which must not block (invalid: the light is on no surface).
ShadowRay shadowRayTo(const LightSample& sample, Point3f p, float time, PrimitiveId start,
                      PrimitiveId target);

/// Radiance that `medium` sends along the shadow ray to its start, from where it is present inside `span`,
/// dimmed by everything on the way: black when a surface with a material is before it. `ray.tMax` is behind
/// the span. Unbiased. `state`: of the start.
Rgb shadowEmission(const Scene& scene, const MediaTracker& tracker, const ShadowRay& shadow,
                   const PlacedMedium& medium, Span<double> span, MediumState state, Rng& rng,
                   RenderCounters& counters, MismatchLog* log);

/// Transmittance of the media along the shadow ray, starting in `state`: black when a surface with a material
/// is in the way. Boundaries without material are crossed. shadowalpha does not apply (closest hits are
/// searched). `state` is then that of the far end.
Rgb shadowTransmittance(const Scene& scene, const MediaTracker& tracker, const ShadowRay& shadow,
                        MediumState& state, Rng& rng, RenderCounters& counters, MismatchLog* log);

}  // namespace pbrtmedia
