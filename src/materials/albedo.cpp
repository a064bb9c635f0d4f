// SPDX-License-Identifier: BSD-2-Clause
#include "materials/albedo.h"

#include <cmath>
#include <cstddef>

namespace pbrtmedia {
namespace {

constexpr std::size_t kPointsPerLobe = 16;
/// The fractional parts of multiples of 1/g and 1/g², g³ = g + 1, are even over the square in any number.
constexpr double kFirstStep = 0.7548776662466927, kSecondStep = 0.5698402909980532;

float fraction(double x) { return static_cast<float>(x - std::floor(x)) * 0.99999994f; }

}  // namespace

Rgb albedoOf(const Bsdf& bsdf, Vector3f wo) {
  const std::size_t lobes = bsdf.count();
  if (lobes == 0) return {};
  Rgb sum;
  for (std::size_t lobe = 0; lobe < lobes; ++lobe) {
    for (std::size_t i = 0; i < kPointsPerLobe; ++i) {
      const double n = static_cast<double>(i) + 0.5;
      // The lobe is picked by the first number, and what is left of it is used again.
      const float within = fraction(n * kFirstStep);
      const float first = (static_cast<float>(lobe) + within) / static_cast<float>(lobes) * 0.9999999f;
      const BsdfSample sample = bsdf.sample(wo, {first, fraction(n * kSecondStep)});
      if (sample.pdf > 0) sum += sample.f * (absDot(sample.wi, bsdf.shadingNormal()) / sample.pdf);
    }
  }
  return sum / static_cast<float>(lobes * kPointsPerLobe);
}

}  // namespace pbrtmedia
