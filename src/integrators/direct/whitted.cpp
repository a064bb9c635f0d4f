// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/direct/whitted.h"

#include "integrators/direct/specular_recursion.h"

namespace pbrtmedia {

Rgb WhittedIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  const SpecularRecursion::Lighting lighting = [&](const ShadedPoint& point, PathSamples& samples) {
    Rgb sum;
    for (std::size_t i = 0; i < scene().lights().size(); ++i) {
      const LitSample lit = sampleLight(scene(), point, i, samples.get2D(), context.counters);
      if (!lit.radiance.isBlack()) sum += lit.scattered * lit.radiance / lit.sample.pdf;
    }
    return sum;
  };
  return SpecularRecursion(scene(), params_.maxDepth, lighting, context).radiance(ray);
}

}  // namespace pbrtmedia
