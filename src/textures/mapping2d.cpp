// SPDX-License-Identifier: BSD-2-Clause
#include "textures/mapping2d.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace pbrtmedia {

namespace {

/// φ in [0, 2π); 0 on the axis.
float azimuth(Vector3f q) {
  const float phi = std::atan2(q.y, q.x);
  return phi < 0 ? phi + 2 * kPi : phi;
}

/// Change of φ/2π for a step d at q, at most half a turn.
float turnOf(Vector3f q, Vector3f d) {
  const float across2 = q.x * q.x + q.y * q.y, numerator = q.x * d.y - q.y * d.x;
  if (d.x == 0 && d.y == 0) return 0;
  if (across2 == 0) return 0.5f;
  return std::clamp(numerator / across2 * kInv2Pi, -0.5f, 0.5f);
}

/// (dθ/π, dφ/2π) for a step d at q.
Vector2f sphericalStep(Vector3f q, Vector3f d) {
  const float across2 = q.x * q.x + q.y * q.y, r2 = across2 + q.z * q.z;
  if (r2 == 0) return {};
  const float across = std::sqrt(across2);
  const float radial = across > 0 ? (q.x * d.x + q.y * d.y) / across : std::hypot(d.x, d.y);
  return {(q.z * radial - across * d.z) / r2 * kInvPi, turnOf(q, d)};
}

/// (dφ/2π, d(z/r)) for a step d at q.
Vector2f cylindricalStep(Vector3f q, Vector3f d) {
  const float r2 = lengthSquared(q);
  if (r2 == 0) return {};
  return {turnOf(q, d), (d.z - q.z * dot(q, d) / r2) / std::sqrt(r2)};
}

}  // namespace

TexCoord2 UvMapping::operator()(const SurfaceInteraction& si) const {
  return {{uScale * si.uv.x + uDelta, vScale * si.uv.y + vDelta},
          {uScale * si.dudx, vScale * si.dvdx},
          {uScale * si.dudy, vScale * si.dvdy}};
}

TexCoord2 SphericalMapping::operator()(const SurfaceInteraction& si) const {
  const Vector3f q = textureFromWorld_.point(si.p);
  const float theta = std::atan2(std::hypot(q.x, q.y), q.z);
  return {{theta * kInvPi, azimuth(q) * kInv2Pi},
          sphericalStep(q, textureFromWorld_.vector(si.dpdx)),
          sphericalStep(q, textureFromWorld_.vector(si.dpdy))};
}

TexCoord2 CylindricalMapping::operator()(const SurfaceInteraction& si) const {
  const Vector3f q = textureFromWorld_.point(si.p);
  const float r = length(q);
  return {{(kPi + std::atan2(q.y, q.x)) * kInv2Pi, r > 0 ? q.z / r : 0},
          cylindricalStep(q, textureFromWorld_.vector(si.dpdx)),
          cylindricalStep(q, textureFromWorld_.vector(si.dpdy))};
}

TexCoord2 PlanarMapping::operator()(const SurfaceInteraction& si) const {
  return {{uDelta + dot(si.p, v1), vDelta + dot(si.p, v2)},
          {dot(si.dpdx, v1), dot(si.dpdx, v2)},
          {dot(si.dpdy, v1), dot(si.dpdy, v2)}};
}

}  // namespace pbrtmedia
