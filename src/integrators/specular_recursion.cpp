// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/specular_recursion.h"

#include "integrators/line_walk.h"

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
  const ShadowRay shadow = shadowRayTo(s, point.si.p, point.time, point.hit.hit.id, scene.lightTarget(light));
  if (!scene.occluded(shadow.ray, 0, shadow.exclusions, counters.shadowRays)) lit.radiance = s.radiance;
  return lit;
}

Rgb SpecularRecursion::radiance(const RayDifferential& ray, PrimitiveId start, int level) {
  Rgb sum;
  LineWalk walk(scene_, ray, Exclusions(start));
  for (;;) {
    const std::optional<SceneHit> hit = walk.next(context_.counters.rays);
    if (!hit) {
      for (const std::uint32_t i : scene_.infiniteLights()) sum += scene_.lights()[i]->background(ray.d);
      return sum;
    }
    const Material* const material = hit->primitive->material;
    if (!material && !hit->isEmitter()) continue;
    ShadedPoint point{*hit, scene_.surface(*hit, ray), {}, ray.time};
    if (hit->isEmitter()) sum += hit->areaLight().emitted(point.si.n, point.si.wo);
    if (!material) continue;
    if (ray.hasDifferentials) point.si.computeDifferentials(ray);
    ++context_.counters.surfaceScatterings;
    samples_.startVertex(level);
    point.bsdf = material->bsdf(point.si, /*mergeSpecular=*/false);
    if (point.bsdf.count(BsdfFlags::AllButSpecular) > 0) sum += lighting_(point, samples_);
    if (level + 1 < maxDepth_) {
      sum += follow(point, ray, BsdfFlags::Reflection, level);
      sum += follow(point, ray, BsdfFlags::Transmission, level);
    }
    return sum;
  }
}

Rgb SpecularRecursion::follow(const ShadedPoint& point, const RayDifferential& ray, BsdfFlags side,
                              int level) {
  const BsdfFlags allowed = side | BsdfFlags::Specular;
  if (point.bsdf.count(allowed) == 0) return {};
  samples_.startVertex(level);
  const BsdfSample s = point.bsdf.sample(point.si.wo, samples_.get2D(), allowed);
  if (!(s.pdf > 0) || s.f.isBlack()) return {};
  const float cosine = absDot(s.wi, point.bsdf.shadingNormal());
  if (cosine == 0) return {};
  const RayDifferential next = side == BsdfFlags::Reflection
                                   ? mirroredRay(point.si, ray, s.wi)
                                   : refractedRay(point.si, ray, s.wi, point.bsdf.eta());
  return s.f * (cosine / s.pdf) * radiance(next, point.hit.hit.id, level + 1);
}

}  // namespace pbrtmedia
