// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/ambientocclusion/ambient_occlusion.h"

#include <vector>

#include "base/interruption.h"
#include "base/warp.h"
#include "world/line_walk.h"

namespace pbrtmedia {

Rgb AmbientOcclusionIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  LineWalk walk = LineWalk::fromCamera(scene(), ray);
  while (const std::optional<SceneHit> hit = walk.next(context.counters.rays)) {
    if (hit->primitive->material) return Rgb(openness(*hit, scene().surface(*hit, ray), ray.time, context));
  }
  return {};
}

float AmbientOcclusionIntegrator::openness(const SceneHit& hit, const SurfaceInteraction& si, float time,
                                           SampleContext& context) const {
  const Frame frame = Frame::fromZ(faceForward(si.n, si.wo));
  std::vector<Point2f> points(static_cast<std::size_t>(params_.samples));
  context.sampler.get2DArray(points);
  Ray ray;
  ray.o = si.p;
  ray.time = time;
  float sum = 0;
  for (const Point2f u : points) {
    leaveIfAbandoned();
    const Vector3f wi = params_.cosineSampling ? sampleCosineHemisphere(u) : sampleUniformHemisphere(u);
    ray.d = frame.toWorld(wi);
    if (scene().occluded(ray, 0, Exclusions(hit.hit.id), context.counters.shadowRays)) continue;
    sum += params_.cosineSampling ? kPi : wi.z / pdfUniformHemisphere();
  }
  return sum / static_cast<float>(params_.samples);
}

}  // namespace pbrtmedia
