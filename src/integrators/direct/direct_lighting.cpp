// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/direct/direct_lighting.h"

#include <vector>

#include "base/warp.h"
#include "integrators/direct/specular_recursion.h"
#include "lights/light.h"
#include "materials/bsdf.h"
#include "world/line_walk.h"

namespace pbrtmedia {
namespace {

/// Emission of one light along a ray: its surface if that is what the ray meets first, or its background.
Rgb emissionAlong(const Scene& scene, std::size_t light, const Ray& ray, PrimitiveId start, float& lightPdf,
                  RenderCounters& counters) {
  LineWalk walk(scene, ray, Exclusions(start));
  const Light& source = *scene.lights()[light];
  const std::uint32_t hider = scene.hiderOf(light);
  while (const std::optional<SceneHit> hit = walk.next(counters.rays)) {
    if (hit->light == light) {
      const SurfaceInteraction si = scene.surface(*hit, ray);
      lightPdf = source.pdf(ray.o, ray.d, &si);
      return hit->areaLight().emitted(si.n, si.wo);
    }
    if (hit->primitive->material || hit->isHider(hider)) return {};
  }
  if (!source.isInfinite()) return {};
  lightPdf = source.pdf(ray.o, ray.d, nullptr);
  return source.background(ray.d);
}

/// Direct light of one light by one light sample and one BSDF sample, weighted by the power heuristic.
Rgb lightOnce(const Scene& scene, const ShadedPoint& point, std::size_t light, Point2f uLight, Point2f uBsdf,
              RenderCounters& counters) {
  Rgb sum;
  const bool isDelta = scene.lights()[light]->isDelta();
  const LitSample lit = sampleLight(scene, point, light, uLight, counters);
  if (!lit.radiance.isBlack()) {
    const float bsdfPdf = isDelta ? 0 : point.bsdf.pdf(point.si.wo, lit.sample.wi, BsdfFlags::AllButSpecular);
    sum += lit.scattered * lit.radiance * (powerHeuristic(lit.sample.pdf, bsdfPdf) / lit.sample.pdf);
  }
  if (isDelta) return sum;
  const BsdfSample s = point.bsdf.sample(point.si.wo, uBsdf, BsdfFlags::AllButSpecular);
  if (!(s.pdf > 0) || s.f.isBlack()) return sum;
  Ray ray;
  ray.o = point.si.p;
  ray.d = s.wi;
  ray.time = point.time;
  float lightPdf = 0;
  const Rgb emitted = emissionAlong(scene, light, ray, point.hit.hit.id, lightPdf, counters);
  if (emitted.isBlack()) return sum;
  const float cosine = absDot(s.wi, point.bsdf.shadingNormal());
  return sum + s.f * emitted * (cosine * powerHeuristic(s.pdf, lightPdf) / s.pdf);
}

}  // namespace

Rgb DirectLightingIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  const std::size_t lightCount = scene().lights().size();
  const auto lightAll = [&](const ShadedPoint& point, PathSamples& samples) {
    Rgb sum;
    std::vector<Point2f> uLight, uBsdf;
    for (std::size_t i = 0; i < lightCount; ++i) {
      const auto n = static_cast<std::size_t>(std::max(1, scene().lights()[i]->sampleCount()));
      samples.get2DArray(n, uLight);
      samples.get2DArray(n, uBsdf);
      Rgb ofLight;
      for (std::size_t j = 0; j < n; ++j) {
        ofLight += lightOnce(scene(), point, i, uLight[j], uBsdf[j], context.counters);
      }
      sum += ofLight / static_cast<float>(n);
    }
    return sum;
  };
  const auto lightOne = [&](const ShadedPoint& point, PathSamples& samples) {
    if (lightCount == 0) return Rgb();
    const auto n = static_cast<float>(lightCount);
    const std::size_t i = std::min(static_cast<std::size_t>(samples.get1D() * n), lightCount - 1);
    const Point2f uLight = samples.get2D(), uBsdf = samples.get2D();
    return n * lightOnce(scene(), point, i, uLight, uBsdf, context.counters);
  };
  SpecularRecursion::Lighting lighting = lightAll;
  if (params_.strategy == DirectLightingParams::Strategy::One) lighting = lightOne;
  return SpecularRecursion(scene(), params_.maxDepth, lighting, context).radiance(ray);
}

}  // namespace pbrtmedia
