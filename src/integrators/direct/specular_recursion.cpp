// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/direct/specular_recursion.h"

#include <utility>

#include "base/interruption.h"
#include "lights/light.h"
#include "materials/albedo.h"
#include "materials/bsdf.h"
#include "materials/material.h"
#include "world/line_walk.h"

namespace pbrtmedia {
namespace {

/// How direction toward the viewer and shading normal change from one pixel to the next.
struct FootprintChange {
  Vector3f wo;      ///< d wo
  Vector3f normal;  ///< d n
  float cosine;     ///< d (wo . n)
};

FootprintChange changeOf(const SurfaceInteraction& si, Normal3f n, Vector3f auxiliaryDirection, float du,
                         float dv, float normalSign) {
  FootprintChange c;
  c.wo = -auxiliaryDirection - si.wo;
  c.normal = normalSign * (du * si.shading.dndu + dv * si.shading.dndv);
  c.cosine = dot(c.wo, n) + dot(si.wo, c.normal);
  return c;
}

RayDifferential rayFrom(const SurfaceInteraction& si, const RayDifferential& ray, Vector3f wi) {
  RayDifferential next;
  next.o = si.p;
  next.d = wi;
  next.time = ray.time;
  next.hasDifferentials = ray.hasDifferentials;
  next.rxOrigin = si.p + si.dpdx;
  next.ryOrigin = si.p + si.dpdy;
  return next;
}

}  // namespace

RayDifferential mirroredRay(const SurfaceInteraction& si, const RayDifferential& ray, Vector3f wi) {
  RayDifferential next = rayFrom(si, ray, wi);
  if (!ray.hasDifferentials) return next;
  const Normal3f n = si.shading.n;
  const float cosine = dot(si.wo, n);
  const auto shifted = [&](Vector3f auxiliary, float du, float dv) {
    const FootprintChange c = changeOf(si, n, auxiliary, du, dv, 1);
    return wi - c.wo + 2 * (cosine * c.normal + c.cosine * n);  // wi = 2 (wo.n) n - wo
  };
  next.rxDirection = shifted(ray.rxDirection, si.dudx, si.dvdx);
  next.ryDirection = shifted(ray.ryDirection, si.dudy, si.dvdy);
  return next;
}

RayDifferential refractedRay(const SurfaceInteraction& si, const RayDifferential& ray, Vector3f wi,
                             float eta) {
  RayDifferential next = rayFrom(si, ray, wi);
  if (!ray.hasDifferentials) return next;
  const bool entering = dot(si.wo, si.shading.n) > 0;
  const float sign = entering ? 1.0f : -1.0f, ratio = entering ? 1 / eta : eta;
  const Normal3f n = sign * si.shading.n;  // on the side of wo
  const float cosine = dot(si.wo, n), cosineT = absDot(wi, n);
  const float mu = ratio * cosine - cosineT;
  const float dmu = ratio - ratio * ratio * cosine / std::max(cosineT, 1e-6f);
  const auto shifted = [&](Vector3f auxiliary, float du, float dv) {
    const FootprintChange c = changeOf(si, n, auxiliary, du, dv, sign);
    return wi - ratio * c.wo + (mu * c.normal + dmu * c.cosine * n);  // wi = mu n - ratio wo
  };
  next.rxDirection = shifted(ray.rxDirection, si.dudx, si.dvdx);
  next.ryDirection = shifted(ray.ryDirection, si.dudy, si.dvdy);
  return next;
}

LitSample sampleLight(const Scene& scene, const ShadedPoint& point, std::size_t light, Point2f u,
                      RenderCounters& counters) {
  LitSample lit;
  lit.sample = scene.lights()[light]->sample(point.si.p, u);
  const LightSample& s = lit.sample;
  if (!(s.pdf > 0) || s.radiance.isBlack()) return lit;
  lit.scattered =
      point.bsdf.f(point.si.wo, s.wi, BsdfFlags::AllButSpecular) * absDot(s.wi, point.bsdf.shadingNormal());
  if (lit.scattered.isBlack()) return lit;
  const ShadowRay shadow = shadowRayTo(scene, light, s, point.si.p, point.time, Exclusions(point.hit.hit.id));
  if (!scene.occluded(shadow.ray, 0, shadow.exclusions, counters.shadowRays, shadow.hider)) {
    lit.radiance = s.radiance;
  }
  return lit;
}

Rgb SpecularRecursion::radiance(const RayDifferential& cameraRay) {
  if (!context_.layers.isWanted()) return evaluate(cameraRay);
  RayLayers layers(context_.layers);
  layers_ = &layers;
  const Rgb radiance = evaluate(cameraRay);
  layers.finish();
  return radiance;
}

/// What is still open are nested expressions a + b (c + d (...)), evaluated from the inside as a recursive
/// function would, however deep.
Rgb SpecularRecursion::evaluate(const RayDifferential& cameraRay) {
  std::vector<Open> open;
  std::optional<Next> next = Next{cameraRay, {}, 0, Rgb(1.0f), Rgb(1.0f)};
  for (;;) {
    Rgb value;
    while (next) {
      std::unique_ptr<Vertex> vertex;
      value = visit(*next, vertex);
      next.reset();
      if (vertex) next = descend(value, std::move(vertex), open);
    }
    while (!next) {
      if (open.empty()) return value;
      Open& last = open.back();
      last.sum += last.factor * value;
      if (last.vertex) {
        next = follow(*last.vertex, BsdfFlags::Transmission);
        last.vertex.reset();
      } else if (last.rest) {
        next = *last.rest;
        last.rest.reset();
      }
      if (next) {
        last.factor = next->factor;
      } else {
        value = last.sum;
        open.pop_back();
      }
    }
  }
}

/// Radiance found at the end of a ray, scattered so often on its way to the camera.
void SpecularRecursion::tell(const Next& at, Rgb radiance, int scatterings) const {
  if (layers_) layers_->addRadiance(at.throughput * radiance, scatterings, RayLayers::Scatterer::Surface);
}

void SpecularRecursion::tellSurface(const ShadedPoint& point) const {
  const SurfaceInteraction& si = point.si;
  layers_->addSurface(Rgb(1), point.hit.t(), faceForward(point.bsdf.shadingNormal(), si.wo), si.p,
                      layers_->wantsAlbedo() ? albedoOf(point.bsdf, si.wo) : Rgb());
}

/// Emission and direct light of what the ray meets. `vertex`: that, where specular lobes are to be followed.
Rgb SpecularRecursion::visit(const Next& at, std::unique_ptr<Vertex>& vertex) {
  Rgb sum;
  const RayDifferential& ray = at.ray;
  const bool isFromCamera = at.level == 0;
  LineWalk walk =
      isFromCamera ? LineWalk::fromCamera(scene_, ray) : LineWalk(scene_, ray, Exclusions(at.start));
  for (;;) {
    leaveIfAbandoned();
    const std::optional<SceneHit> hit = walk.next(context_.counters.rays);
    if (!hit) {
      for (const std::uint32_t i : scene_.infiniteLights()) sum += scene_.lights()[i]->background(ray.d);
      if (layers_ && isFromCamera) layers_->addEscape(Rgb(1));
      tell(at, sum, at.level);
      return sum;
    }
    const Material* const material = hit->primitive->material;
    if (!material) continue;  // nor is it seen that it emits, as in PBRT-v3
    ShadedPoint point{*hit, scene_.surface(*hit, ray), {}, ray.time};
    if (hit->isEmitter()) sum += hit->areaLight().emitted(point.si.n, point.si.wo);
    tell(at, sum, at.level);
    if (ray.hasDifferentials) point.si.computeDifferentials(ray);
    ++context_.counters.surfaceScatterings;
    samples_.startVertex(at.level);
    point.bsdf = material->bsdf(point.si, TransportMode::Radiance, /*mergeSpecular=*/false);
    if (layers_ && isFromCamera) tellSurface(point);
    if (point.bsdf.count(BsdfFlags::AllButSpecular) > 0) {
      const Rgb lit = lighting_(point, samples_);
      tell(at, lit, at.level + 1);
      sum += lit;
    }
    if (at.level + 1 < maxDepth_ && point.bsdf.count() > point.bsdf.count(BsdfFlags::AllButSpecular)) {
      vertex = std::make_unique<Vertex>(Vertex{point, ray, at.level, at.throughput});
    }
    return sum;
  }
}

/// Opens `vertex`, where `value` was found. The ray to follow first; none: it ends here.
std::optional<SpecularRecursion::Next> SpecularRecursion::descend(Rgb value, std::unique_ptr<Vertex> vertex,
                                                                  std::vector<Open>& open) {
  std::optional<Next> next = follow(*vertex, BsdfFlags::Reflection);
  if (vertex->level < kExactLevels) {
    // The random numbers of the transmitted ray come after those of all that the reflected one meets.
    if (!next) {
      next = follow(*vertex, BsdfFlags::Transmission);
      vertex.reset();
    } else if (vertex->point.bsdf.count(BsdfFlags::Transmission | BsdfFlags::Specular) == 0) {
      vertex.reset();
    }
    if (next) open.push_back({value, next->factor, std::move(vertex), nullptr});
    return next;
  }
  std::optional<Next> rest = follow(*vertex, BsdfFlags::Transmission);
  if (!next) next = std::exchange(rest, std::nullopt);
  if (!next) return next;
  Open& last = open.back();
  if (rest || last.vertex || last.rest) {
    open.push_back({value, next->factor, nullptr, rest ? std::make_unique<Next>(*rest) : nullptr});
  } else {  // a + b (c + d x) = (a + b c) + b d x
    last.sum += last.factor * value;
    last.factor *= next->factor;
  }
  return next;
}

std::optional<SpecularRecursion::Next> SpecularRecursion::follow(const Vertex& from, BsdfFlags side) {
  const ShadedPoint& point = from.point;
  const BsdfFlags allowed = side | BsdfFlags::Specular;
  if (point.bsdf.count(allowed) == 0) return std::nullopt;
  samples_.startVertex(from.level);
  const BsdfSample s = point.bsdf.sample(point.si.wo, samples_.get2D(), allowed);
  if (!(s.pdf > 0) || s.f.isBlack()) return std::nullopt;
  const float cosine = absDot(s.wi, point.bsdf.shadingNormal());
  if (cosine == 0) return std::nullopt;
  const Rgb factor = s.f * (cosine / s.pdf), throughput = from.throughput * factor;
  if (from.level >= kExactLevels && throughput.isBlack()) return std::nullopt;
  const RayDifferential ray = side == BsdfFlags::Reflection
                                  ? mirroredRay(point.si, from.ray, s.wi)
                                  : refractedRay(point.si, from.ray, s.wi, point.bsdf.eta());
  return Next{ray, point.hit.hit.id, from.level + 1, factor, throughput};
}

}  // namespace pbrtmedia
