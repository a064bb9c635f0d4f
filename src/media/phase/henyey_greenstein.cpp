// SPDX-License-Identifier: BSD-2-Clause
#include "media/phase/henyey_greenstein.h"

#include <cmath>
#include <string>

#include "base/diagnostics.h"
#include "base/math.h"

namespace pbrtmedia {

HenyeyGreenstein::HenyeyGreenstein(float g) : g_(g) {
  if (!(g > -1 && g < 1)) {
    throw SceneError(
        SourceLocation{},
        "Henyey-Greenstein \"g\" must lie between -1 and 1, both excluded; found " + std::to_string(g));
  }
}

float HenyeyGreenstein::evaluate(Vector3f wo, Vector3f wi) const {
  // 1 + g² + 2 g dot(wo, wi) = (1 - |g|)² + |g| |wo ± wi|² for unit vectors: no cancellation at the peak.
  const double g = g_, a = std::abs(g);
  const Vec3d v = g > 0 ? Vec3d(wo) + Vec3d(wi) : Vec3d(wo) - Vec3d(wi);
  const double base = sqr(1 - a) + a * lengthSquared(v);
  return static_cast<float>((1 - a) * (1 + a) / (4 * std::numbers::pi * base * std::sqrt(base)));
}

PhaseFunction::Sample HenyeyGreenstein::sample(Vector3f wo, Point2f u) const {
  // With m the cosine to the direction of travel -wo, inverting the distribution function gives
  //   1 - m = 2 (1 - g)² (1 - u)(1 + g u) / D²,  1 + m = 2 (1 + g)² u (1 - g (1 - u)) / D²,
  //   D = (1 - g)(1 - u) + (1 + g) u,
  // where every term is a product or sum of positive numbers; at g = 0 it is the uniform sphere.
  const double g = g_, x = u.x, y = 1 - x;
  const double d = (1 - g) * y + (1 + g) * x, scale = 2 / (d * d);
  const double oneMinusCos = scale * sqr(1 - g) * y * (1 + g * x);
  const double onePlusCos = scale * sqr(1 + g) * x * (1 - g * y);
  const double cosTheta = oneMinusCos < onePlusCos ? 1 - oneMinusCos : onePlusCos - 1;
  const double sinTheta = std::sqrt(oneMinusCos * onePlusCos), phi = 2 * std::numbers::pi * u.y;
  const Frame frame = Frame::fromZ(-wo);
  const Vector3f local(static_cast<float>(sinTheta * std::cos(phi)),
                       static_cast<float>(sinTheta * std::sin(phi)), static_cast<float>(cosTheta));
  const Vector3f wi = normalize(frame.toWorld(local));
  return {wi, evaluate(wo, wi)};
}

}  // namespace pbrtmedia
