// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/gamma_variate.h"

#include <cmath>
#include <numbers>

namespace pbrtmedia {
namespace {

/// Box & Muller 1958; one of the pair, so that each number belongs to one variate.
double standardNormal(SampleStream& stream) {
  const double radius = std::sqrt(-2 * std::log(stream.uniformAboveZero()));
  return radius * std::cos(2 * std::numbers::pi * stream.uniform());
}

/// log of a Gamma(shape, scale 1 / shape) variate for shape >= 1.
double logGammaVariate(double shape, SampleStream& stream) {
  const double d = shape - 1.0 / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = standardNormal(stream), u = stream.uniformAboveZero();
    if (!(c * x > -1)) continue;
    // d v with v = (1 + c x)^3 is accepted if log u < x^2 / 2 + d (1 - v + log v). For large d, v - 1 and log
    // v are small and nearly equal: both are formed without subtracting from 1.
    const double cx = c * x, logV = 3 * std::log1p(cx), vMinusOne = cx * (3 + cx * (3 + cx));
    if (std::log(u) < x * x / 2 + d * (logV - vMinusOne)) return logV + std::log1p(-1 / (3 * shape));
  }
}

}  // namespace

double gammaVariate(double shape, SampleStream& stream) {
  if (shape >= 1) return std::exp(logGammaVariate(shape, stream));
  // Gamma(a) = Gamma(a + 1) U^(1/a); both scales are 1 / shape here.
  const double larger = logGammaVariate(shape + 1, stream) + std::log((shape + 1) / shape);
  return std::exp(larger + std::log(stream.uniformAboveZero()) / shape);
}

}  // namespace pbrtmedia
