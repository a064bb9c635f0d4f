// SPDX-License-Identifier: BSD-2-Clause
// What a path collects: light samples at its vertices and along its stretches, and what it meets that emits.
#include <algorithm>
#include <array>
#include <span>

#include "base/warp.h"
#include "integrators/path/path_tracer.h"
#include "materials/albedo.h"
#include "materials/bsdf.h"
#include "world/boundary_planes.h"
#include "world/medium_light.h"

namespace pbrtmedia {
namespace {

/// Scatterings of an exploratory path whose light samples are noted: later ones have little part in the
/// noise.
constexpr int kExploredBounces = 16;

/// Media that scatter this share of what they take away, or more, find uniform lights by scattering alone.
constexpr float kHighAlbedo = .93f;

/// Whether sampling the BSDF reaches every direction in which it scatters. With a shading normal, or glossy
/// lobes, some can be reached by light samples only.
bool samplingCoversBsdf(const Bsdf& bsdf, const SurfaceInteraction& si) {
  return bsdf.count(BsdfFlags::AllDiffuse) == bsdf.count() && bsdf.shadingNormal() == si.n;
}

/// Whether light on the far side is scattered toward the near one.
bool letsThrough(const Bsdf& bsdf) {
  return bsdf.count(without(BsdfFlags::AllButSpecular, BsdfFlags::Transmission)) !=
         bsdf.count(BsdfFlags::AllButSpecular);
}

}  // namespace

void PathTracer::gather(Rgb radiance, int scatterings, RayLayers::Scatterer here) {
  radiance_ += radiance;
  if (layers_) layers_->addRadiance(radiance, scatterings, bounces_ == 0 ? here : first_);
}

void PathTracer::tellSurface(const Bsdf& bsdf) {
  const SurfaceInteraction& si = surface_.si;
  first_ = RayLayers::Scatterer::Surface;
  layers_->addSurface(beta_, surface_.hit.t(), faceForward(bsdf.shadingNormal(), si.wo), si.p,
                      layers_->wantsAlbedo() ? albedoOf(bsdf, si.wo) : Rgb());
}

void PathTracer::tellScattering() {
  first_ = RayLayers::Scatterer::Medium;
  layers_->addScattering(beta_, medium_.t);
}

/// A light for the receiver and a point on it; nothing when light sampling has no part in the estimate.
std::optional<PathTracer::PickedLight> PathTracer::pickLight() {
  const Point3f p = receiver_.p;
  if (setup_.lightCount == 0) return std::nullopt;
  const auto& lights = setup_.scene.lights();
  const auto skips = [&](std::size_t i) {
    return receiver_.findsUniformLights && i < lights.size() && lights[i]->isUniformInfinite();
  };
  if (setup_.lightCount == 1 && skips(0)) return std::nullopt;
  const LightSelector::Choice choice = setup_.selector->choose(receiver_, samples_.get1D());
  const Point2f u = samples_.get2D();
  if (skips(choice.light)) return std::nullopt;
  const MediumLight* const emitter = setup_.scene.mediumLight(choice.light);
  PickedLight picked{
      choice.light, choice.probability,
      emitter ? emitter->sampleDirection(p, u, ray_.time) : lights[choice.light]->sample(p, u)};
  if (!(picked.sample.pdf > 0) || (!emitter && picked.sample.radiance.isBlack())) return std::nullopt;
  picked.sample.pdf *= choice.probability;
  return picked;
}

/// What of a light sample's radiance arrives at `p`; of a medium, what it sends there from that direction.
Rgb PathTracer::arriving(const PickedLight& light, Point3f p, const Exclusions& start,
                         const MediumState& state, const ScatterPoint* from) {
  const Scene& scene = setup_.scene;
  const LightSample& s = light.sample;
  ShadowRay shadow = shadowRayTo(scene, light.index, s, p, ray_.time, start);
  shadow.from = from;
  if (!setup_.media) {
    const bool occluded =
        scene.occluded(shadow.ray, 0, shadow.exclusions, counters_.shadowRays, shadow.hider);
    return occluded ? Rgb() : s.radiance;
  }
  if (const MediumLight* const emitter = scene.mediumLight(light.index)) {
    const auto span = emitter->span(p, s.wi, ray_.time);
    if (!span) return {};
    shadow.ray.tMax = s.distance;
    return shadowEmission(shadowContext(), shadow, emitter->medium(), *span, state, context_.stream());
  }
  MediumState end = state;
  return s.radiance * shadowTransmittance(shadowContext(), shadow, end, context_.stream());
}

/// Share of a light sample; what a direction of that density finds accounts for the rest.
float PathTracer::lightWeight(const PickedLight& light, float directionPdf) const {
  const auto& lights = setup_.scene.lights();
  if (light.index < lights.size() && lights[light.index]->isDelta()) return 1;
  return powerHeuristic(comparableDensity(light), directionPdf);
}

/// Of a light sample, as what directions find weighs it: without the pick where a light is one of many parts.
float PathTracer::comparableDensity(const PickedLight& light) const {
  const auto& lights = setup_.scene.lights();
  const LightSample& s = light.sample;
  return light.index < lights.size() && lights[light.index]->isSplit() ? s.pdf / light.probability : s.pdf;
}

/// Whether `arrivingShare` has to divide the work. Emission of media is found by distances, not by flights.
bool PathTracer::sharesByTransmittance(const PickedLight& light, float directionPdf) const {
  const auto& lights = setup_.scene.lights();
  return knowsTransmittance(bounces_ + 1) && directionPdf > 0 && light.index < lights.size() &&
         !lights[light.index]->isDelta();
}

/// What of a light sample's radiance arrives at `p`, times its share.
Rgb PathTracer::arrivingShare(const PickedLight& light, Point3f p, const Exclusions& start,
                              const MediumState& state, float directionPdf, const ScatterPoint* from) {
  const LightSample& s = light.sample;
  ShadowRay shadow = shadowRayTo(setup_.scene, light.index, s, p, ray_.time, start);
  shadow.from = from;
  const TransmittanceShares shares(comparableDensity(light), directionPdf);
  MediumState end = state;
  switch (setup_.params.misTransmittance) {
    case MisTransmittance::Independent: {
      std::array<PairedTransmittance, 2> through;
      dimByShadow(shadowContext(), shadow, end, context_.stream(), through);
      return s.radiance * shares.litThrough(through[0], through[1]);
    }
    case MisTransmittance::Joint: {
      PairedTransmittance through;
      dimByShadow(shadowContext(), shadow, end, context_.stream(), std::span(&through, 1));
      return s.radiance * shares.jointLitThrough(through);
    }
    case MisTransmittance::None:
    case MisTransmittance::Bounds:
      break;
  }
  const ControlledTransmittance through =
      controlledShadowTransmittance(shadowContext(), shadow, end, context_.stream());
  return s.radiance * through.value * shares.lightShare({exp(-through.controlDepth), Rgb()});
}

/// Share of a collision's sample of a light at one point; `lightStretch` accounts for the rest.
float PathTracer::collisionShare(std::size_t light, Point3f p) const {
  if (!medium_.extinction) return 1;
  const MediaStretch stretch(state_, ray_, medium_.tMin, medium_.tMax);
  return setup_.singleScattering->collisionShare(setup_.singleScattering->with(stretch, *medium_.extinction),
                                                 light, medium_.t, p);
}

/// What a light sample brings.
void PathTracer::gatherLight(const PickedLight& light, Rgb radiance, RayLayers::Scatterer here) {
  gather(radiance, bounces_ + 1, here);
  if (context_.lightTrials && bounces_ < kExploredBounces)
    setup_.selector->note(receiver_, light.index, static_cast<double>(radiance.luminance()),
                          *context_.lightTrials);
}

void PathTracer::lightSurface(const Bsdf& bsdf) {
  const SurfaceInteraction& si = surface_.si;
  receiver_ = LightReceiver(si.p);
  receiver_.findsUniformLights = samplingCoversBsdf(bsdf, si);
  if (setup_.lightCount > 1 && !letsThrough(bsdf))
    receiver_.n = Vector3f(faceForward(bsdf.shadingNormal(), si.wo));
  const std::optional<PickedLight> light = pickLight();
  if (!light) return;
  const LightSample& s = light->sample;
  const Rgb f = bsdf.f(si.wo, s.wi, BsdfFlags::AllButSpecular) * absDot(s.wi, bsdf.shadingNormal());
  if (f.isBlack()) return;
  const auto& lights = setup_.scene.lights();
  const bool isDelta = light->index < lights.size() && lights[light->index]->isDelta();
  const float directionPdf = isDelta ? 0 : bsdf.pdf(si.wo, s.wi);
  MediumState state = state_;
  if (setup_.media) {
    setup_.media->leaveSurface(state, surface_.hit, si, surface_.coincident, s.wi, counters_,
                               context_.mismatches);
  }
  const Exclusions start = surface_.coincident.startingWith(surface_.hit.hit.id);
  if (sharesByTransmittance(*light, directionPdf)) {
    gatherLight(*light, beta_ * f * (1 / s.pdf) * arrivingShare(*light, si.p, start, state, directionPdf),
                RayLayers::Scatterer::Surface);
    return;
  }
  const float weight = isDelta ? 1 : lightWeight(*light, directionPdf);
  gatherLight(*light, beta_ * f * (weight / s.pdf) * arriving(*light, si.p, start, state),
              RayLayers::Scatterer::Surface);
}

void PathTracer::lightMedium() {
  // A phase function samples a uniform light perfectly, but not what dims it on the way: it arrives, or the
  // path scatters again and finds it later. Where hardly anything is absorbed both bring the same, and a
  // light sample is noise beside it: without it variance times time is .03 to .4 of what it was at an albedo
  // of .99 and .1 to .9 at .95; but up to 1.6 at .9, and 1.8 at .8 and in a smoke that scatters a tenth.
  receiver_ = LightReceiver(medium_.at.p);
  receiver_.phase = medium_.phase;
  receiver_.wo = -ray_.d;
  receiver_.findsUniformLights =
      medium_.scattered >= kHighAlbedo && setup_.selector && setup_.selector->leavesOutUniformLights();
  const std::optional<PickedLight> light = pickLight();
  if (!light) return;
  const LightSample& s = light->sample;
  const float phase = medium_.phase->evaluate(-ray_.d, s.wi);
  if (!(phase > 0)) return;
  if (sharesByTransmittance(*light, phase)) {
    gatherLight(*light,
                beta_ * (phase / s.pdf) * arrivingShare(*light, medium_.at.p, {}, state_, phase, &medium_.at),
                RayLayers::Scatterer::Medium);
    return;
  }
  const float weight = lightWeight(*light, phase) * collisionShare(light->index, medium_.at.p);
  if (!(weight > 0)) return;
  gatherLight(*light,
              beta_ * (phase * weight / s.pdf) * arriving(*light, medium_.at.p, {}, state_, &medium_.at),
              RayLayers::Scatterer::Medium);
}

/// Single scattering of a light at one point, at a distance chosen for that light. The flight that follows
/// may collide and sample the same light: `collisionShare` divides the work.
void PathTracer::lightStretch(const LitStretch& stretch, const SceneHit* hit, const BoundaryPlane& start) {
  const float u = samples_.get1D(), v = samples_.get1D();
  const std::span<const Explorer> near =
      setup_.explorers && bounces_ == 0 ? setup_.explorers->of(context_.pixel) : std::span<const Explorer>();
  setup_.singleScattering->sample(
      stretch, {u, v}, near, context_.rng, counters_, [&](const StretchSample& sample) {
        const ScatterPoint at =
            scatterPointOn(setup_.scene, ray_, sample.t, stretch.media.tMax(), hit, start, counters_);
        if (!isFinite(at.p)) return;
        gather(
            setup_.singleScattering->radiance(stretch, sample, at, beta_, shadowContext(), context_.stream()),
            bounces_ + 1, RayLayers::Scatterer::Medium);
      });
}

/// What the media emit between two surfaces.
void PathTracer::collectMediumEmission(const MediaStretch& stretch) {
  for (std::size_t i = 0; i < state_.activeCount(); ++i) {
    const PlacedMedium m = state_.active(i);
    if (!m.medium->isEmissive()) continue;
    const EmissionSamples found = stretch.sampleEmission(i, context_.stream(), counters_);
    if (found.count == 0) continue;
    const std::optional<std::size_t> light = isDirect_ ? std::nullopt : setup_.scene.lightOf(m);
    const MediumLight* const source = light ? setup_.scene.mediumLight(*light) : nullptr;
    const auto span = source ? source->span(ray_.o, ray_.d, ray_.time) : std::nullopt;
    const float weight = span ? mediumEmissionWeight(*source, *light) : 1;
    for (const EmissionSamples::Sample& e : found) {
      // Light samples look inside the span only.
      const bool isShared = span && e.t >= span->tMin && e.t <= span->tMax;
      gather(beta_ * e.radiance * (isShared ? weight : 1.0f), bounces_, first_);
    }
  }
}

/// Share of the emission found by the current segment; light sampling at its start accounts for the rest.
Rgb PathTracer::emissionWeight(std::size_t light, const SurfaceInteraction* si) {
  if (isDirect_) return Rgb(1);
  if (light == SceneHit::kNoLight) return Rgb();  // visible, but no source of illumination
  const Light& source = *setup_.scene.lights()[light];
  if (receiver_.findsUniformLights && source.isUniformInfinite()) return Rgb(1);
  const float probability = source.isSplit() ? 1 : setup_.selector->probability(receiver_, light);
  const float lightPdf = probability * source.pdf(ray_.o, ray_.d, si);
  if (!knowsTransmittance(bounces_)) return Rgb(powerHeuristic(directionPdf_, lightPdf));
  if (!(lightPdf > 0)) return Rgb(1);
  return scatteringShare({lightPdf, directionPdf_});
}

/// Share of what the current segment has found behind the media that it has passed, by bounds or an estimate
/// that knows nothing of its flights.
Rgb PathTracer::scatteringShare(const TransmittanceShares& shares) {
  const auto stretchOf = [&](const PassedStretch& passed) {
    return MediaStretch(passed.state, ray_, passed.tMin, passed.tMax);
  };
  if (setup_.params.misTransmittance == MisTransmittance::Bounds) {
    Rgb depth;
    for (const PassedStretch& s : passed_) depth += stretchOf(s).control().depth;
    return shares.scatteringShare({exp(-depth), Rgb()});
  }
  PairedTransmittance through;
  for (const PassedStretch& s : passed_) {
    if (through.isBlack()) break;
    through *= stretchOf(s).pairedTransmittance(context_.stream(), counters_);
  }
  return setup_.params.misTransmittance == MisTransmittance::Joint ? shares.jointScatteringShare(through)
                                                                   : shares.scatteringShare(through);
}

/// The same for emission of a medium, number `light` of Scene::illuminants().
float PathTracer::mediumEmissionWeight(const MediumLight& source, std::size_t light) const {
  const double lightPdf =
      double{setup_.selector->probability(receiver_, light)} * source.directionPdf(ray_.o, ray_.d, ray_.time);
  return powerHeuristic(directionPdf_, static_cast<float>(lightPdf));
}

/// An emitter without material illuminates by its side that is met first. Directly seen are all.
void PathTracer::collectEmission(Way& way, const SceneHit& hit, const SurfaceInteraction& si) {
  if (!isDirect_ && hit.light != SceneHit::kNoLight && !hit.primitive->material) {
    if (std::ranges::find(way.passedEmitters, hit.hit.id.geometry) != way.passedEmitters.end()) return;
    way.passedEmitters.push_back(hit.hit.id.geometry);
  }
  const Rgb emitted = hit.areaLight().emitted(si.n, si.wo);
  if (!emitted.isBlack()) gather(beta_ * emitted * emissionWeight(hit.light, &si), bounces_, first_);
}

void PathTracer::collectBackground() {
  for (const std::uint32_t light : setup_.scene.infiniteLights()) {
    const Rgb background = setup_.scene.lights()[light]->background(ray_.d);
    if (!background.isBlack()) gather(beta_ * background * emissionWeight(light, nullptr), bounces_, first_);
  }
}

}  // namespace pbrtmedia
