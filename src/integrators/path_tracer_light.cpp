// SPDX-License-Identifier: BSD-2-Clause
// What a path collects: light samples at its vertices and along its stretches, and what it meets that emits.
#include "base/warp.h"
#include "integrators/medium_light.h"
#include "integrators/path_tracer.h"

namespace pbrtmedia {

/// A light and a point on it; nothing when light sampling has no part in the estimate.
std::optional<PathTracer::PickedLight> PathTracer::pickLight(Point3f p, bool scatteringFindsUniformLights) {
  const auto& lights = setup_.lights;
  if (lights.empty()) return std::nullopt;
  const auto skips = [&](std::size_t i) {
    return scatteringFindsUniformLights && lights[i]->isUniformInfinite();
  };
  if (lights.size() == 1 && skips(0)) return std::nullopt;
  const LightSelector::Choice choice = setup_.selector->choose(p, samples_.get1D());
  const Point2f u = samples_.get2D();
  if (skips(choice.light)) return std::nullopt;
  const MediumLight* const emitter = setup_.scene.mediumLight(choice.light);
  PickedLight picked{choice.light,
                     emitter ? emitter->sample(p, u, ray_.time) : lights[choice.light]->sample(p, u)};
  if (!(picked.sample.pdf > 0) || picked.sample.radiance.isBlack()) return std::nullopt;
  picked.sample.pdf *= choice.probability;
  return picked;
}

Rgb PathTracer::unoccluded(const PickedLight& light, Point3f p, PrimitiveId start, const MediumState& state) {
  const Scene& scene = setup_.scene;
  ShadowRay shadow = shadowRayTo(light.sample, p, ray_.time, start, scene.lightTarget(light.index));
  if (setup_.media) {
    const MediumLight* const emitter = scene.mediumLight(light.index);
    if (emitter) shadow.ray.tMax = light.sample.distance;
    MediumState end = state;
    const Rgb through =
        shadowTransmittance(scene, *setup_.media, shadow, end, context_.rng, counters_, context_.mismatches);
    if (!emitter || through.isBlack()) return through;
    // As often as the medium is there, as distances are sampled.
    float present = 0;
    for (std::size_t i = 0; i < end.activeCount(); ++i) {
      if (end.active(i) == emitter->medium()) ++present;
    }
    return through * present;
  }
  return Rgb(scene.occluded(shadow.ray, 0, shadow.exclusions, counters_.shadowRays) ? 0.0f : 1.0f);
}

/// Share of a light sample at `p`; what a direction of that density finds accounts for the rest.
float PathTracer::lightWeight(const PickedLight& light, Point3f p, float directionPdf) const {
  if (setup_.lights[light.index]->isDelta()) return 1;
  const LightSample& s = light.sample;
  if (const MediumLight* const emitter = setup_.scene.mediumLight(light.index)) {
    directionPdf *= static_cast<float>(emitter->distancePdf(p, s.wi, double{s.distance}, ray_.time));
  }
  return powerHeuristic(s.pdf, directionPdf);
}

/// Share of a collision's sample of a light at one point; `lightStretch` accounts for the rest.
float PathTracer::collisionShare(std::size_t light, Point3f p) const {
  if (!medium_.lightsStretch || !setup_.positionLights->contains(light)) return 1;
  const MediumLightSampling sampling = setup_.params.mediumLightSampling;
  if (sampling == MediumLightSampling::Equiangular) return 0;
  const double stretch =
      setup_.positionLights->pdf(light, {ray_, medium_.tMin, medium_.tMax, medium_.extinction}, medium_.t);
  if (!(stretch > 0)) return 1;
  if (sampling == MediumLightSampling::Auto) return 0;
  const double flight = MediaTracker::flightDensity(state_, ray_, medium_.tMin, medium_.t) *
                        double{setup_.selector->probability(p, light)};
  return static_cast<float>(flight / (flight + stretch));
}

void PathTracer::lightSurface(const Bsdf& bsdf) {
  const SurfaceInteraction& si = surface_.si;
  const std::optional<PickedLight> light = pickLight(si.p, ownsUniformLights_);
  if (!light) return;
  const LightSample& s = light->sample;
  const Rgb f = bsdf.f(si.wo, s.wi, BsdfFlags::AllButSpecular) * absDot(s.wi, bsdf.shadingNormal());
  if (f.isBlack()) return;
  const bool isDelta = setup_.lights[light->index]->isDelta();
  const float weight = isDelta ? 1 : lightWeight(*light, si.p, bsdf.pdf(si.wo, s.wi));
  MediumState state = state_;
  if (setup_.media) {
    setup_.media->leaveSurface(state, surface_.hit, si, s.wi, counters_, context_.mismatches);
  }
  radiance_ +=
      beta_ * f * s.radiance * (weight / s.pdf) * unoccluded(*light, si.p, surface_.hit.hit.id, state);
}

void PathTracer::lightMedium() {
  const std::optional<PickedLight> light = pickLight(medium_.p, ownsUniformLights_);
  if (!light) return;
  const LightSample& s = light->sample;
  const float phase = medium_.phase->evaluate(-ray_.d, s.wi);
  if (!(phase > 0)) return;
  const float weight = lightWeight(*light, medium_.p, phase) * collisionShare(light->index, medium_.p);
  if (!(weight > 0)) return;
  radiance_ += beta_ * s.radiance * (phase * weight / s.pdf) * unoccluded(*light, medium_.p, {}, state_);
}

/// Single scattering of a light at one point, at a distance chosen for that light. The flight that follows
/// may collide and sample the same light: `collisionShare` divides the work.
void PathTracer::lightStretch(const PositionLights::Stretch& stretch, const SceneHit* hit,
                              const BoundaryPlane& start) {
  const float u = samples_.get1D(), v = samples_.get1D();
  const auto choice = setup_.positionLights->sample(stretch, u, v);
  if (!choice) return;
  const Point3f p = mediumPoint(choice->t, stretch.tMax, hit, start);
  if (!isFinite(p)) return;
  const PickedLight light{choice->light, setup_.lights[choice->light]->sample(p, {})};
  const LightSample& s = light.sample;
  if (!(s.pdf > 0) || s.radiance.isBlack()) return;
  const Rgb scattered = MediaTracker::scattering(state_, ray_, choice->t, -ray_.d, s.wi, counters_);
  if (scattered.isBlack()) return;
  double density = choice->pdf;
  if (setup_.params.mediumLightSampling == MediumLightSampling::Mis) {
    density += MediaTracker::flightDensity(state_, ray_, stretch.tMin, choice->t) *
               double{setup_.selector->probability(p, choice->light)};
  }
  const Rgb through =
      MediaTracker::transmittance(state_, ray_, stretch.tMin, choice->t, context_.rng, counters_);
  if (through.isBlack()) return;
  radiance_ += beta_ * through * scattered * s.radiance * static_cast<float>(1 / density) *
               unoccluded(light, p, {}, state_);
}

/// What the media emit between two surfaces, at one distance for each that does.
void PathTracer::collectMediumEmission(double tMin, double tMax) {
  for (std::size_t i = 0; i < state_.activeCount(); ++i) {
    const PlacedMedium m = state_.active(i);
    if (!m.medium->isEmissive()) continue;
    const EmissionDistance e =
        MediaTracker::sampleEmission(state_, i, ray_, tMin, tMax, context_.rng, counters_);
    if (!(e.pdf > 0) || e.emission.isBlack()) continue;
    const Rgb through = MediaTracker::transmittance(state_, ray_, tMin, e.t, context_.rng, counters_);
    radiance_ += beta_ * through * e.emission * static_cast<float>(1 / e.pdf) * mediumEmissionWeight(m, e.t);
  }
}

/// Share of the emission found by the current segment; light sampling at its start accounts for the rest.
float PathTracer::emissionWeight(std::size_t light, const SurfaceInteraction* si) const {
  if (isDirect_) return 1;
  if (light == SceneHit::kNoLight) return 0;  // visible, but no source of illumination
  const Light& source = *setup_.lights[light];
  if (ownsUniformLights_ && source.isUniformInfinite()) return 1;
  const float lightPdf = setup_.selector->probability(ray_.o, light) * source.pdf(ray_.o, ray_.d, si);
  return powerHeuristic(directionPdf_, lightPdf);
}

/// The same for emission that a medium shows at `t` of the segment.
float PathTracer::mediumEmissionWeight(const PlacedMedium& medium, double t) const {
  if (isDirect_) return 1;
  const std::optional<std::size_t> light = setup_.scene.lightOf(medium);
  if (!light) return 1;
  const MediumLight& source = *setup_.scene.mediumLight(*light);
  const double lightPdf =
      double{setup_.selector->probability(ray_.o, *light)} * source.pdfAt(ray_.o, ray_.d, t, ray_.time);
  if (!(lightPdf > 0)) return 1;  // outside of what light samples look at
  return powerHeuristic(static_cast<float>(directionPdf_ * source.distancePdf(ray_.o, ray_.d, t, ray_.time)),
                        static_cast<float>(lightPdf));
}

void PathTracer::collectEmission(const SceneHit& hit, const SurfaceInteraction& si) {
  const Rgb emitted = hit.areaLight().emitted(si.n, si.wo);
  if (!emitted.isBlack()) radiance_ += beta_ * emitted * emissionWeight(hit.light, &si);
}

void PathTracer::collectBackground() {
  for (const std::uint32_t light : setup_.scene.infiniteLights()) {
    const Rgb background = setup_.lights[light]->background(ray_.d);
    if (!background.isBlack()) radiance_ += beta_ * background * emissionWeight(light, nullptr);
  }
}

}  // namespace pbrtmedia
