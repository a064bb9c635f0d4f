// SPDX-License-Identifier: BSD-2-Clause
#include "media/phase/rayleigh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math.h"

namespace pbrtmedia {

float Rayleigh::evaluate(Vector3f wo, Vector3f wi) const {
  const float c = dot(wo, wi);
  return static_cast<float>(3 / (16 * std::numbers::pi)) * (1 + c * c);
}

PhaseFunction::Sample Rayleigh::sample(Vector3f wo, Point2f u) const {
  // The cosine m has Pr{<= m} = (m³ + 3 m + 4) / 8 = u, so m³ + 3 m = 2 w with w = 4 u - 2. With m = 2
  // sinh(x) that is 2 sinh(3 x) = 2 w: no difference of cube roots, all digits kept around m = 0.
  const double w = 4 * static_cast<double>(u.x) - 2;
  const double m = std::clamp(2 * std::sinh(std::asinh(w) / 3), -1.0, 1.0);
  const double s = std::sqrt((1 - m) * (1 + m)), phi = 2 * std::numbers::pi * static_cast<double>(u.y);
  const Vector3f local(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                       static_cast<float>(m));
  const Vector3f wi = normalize(Frame::fromZ(wo).toWorld(local));
  return {wi, evaluate(wo, wi)};
}

}  // namespace pbrtmedia
