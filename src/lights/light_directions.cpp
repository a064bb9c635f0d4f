// SPDX-License-Identifier: BSD-2-Clause
#include "lights/light_directions.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace pbrtmedia {
namespace {

constexpr float kSimilarityTolerance = 1e-5f;  // of squared lengths: rounding of a float rotation, no more

/// True when the columns are orthogonal and of one length, so that solid angles keep their size.
bool isSimilarity(const Affine3f& m) {
  const float scale2 = lengthSquared(m.x), most = kSimilarityTolerance * scale2;
  return std::abs(lengthSquared(m.y) - scale2) <= most && std::abs(lengthSquared(m.z) - scale2) <= most &&
         std::abs(dot(m.x, m.y)) <= most && std::abs(dot(m.y, m.z)) <= most &&
         std::abs(dot(m.z, m.x)) <= most;
}

}  // namespace

LightDirections::LightDirections(const Transform& worldFromLight, const char* light)
    : worldFromLight_(worldFromLight.matrix()),
      lightFromWorld_(worldFromLight.inverseMatrix()),
      inverseDeterminant_(static_cast<float>(std::abs(worldFromLight.inverseMatrix().determinant3()))),
      keepsSolidAngles_(isSimilarity(lightFromWorld_)) {
  if (worldFromLight.isSingular()) {
    throw std::invalid_argument(std::string(light) + " light: the transform has no inverse");
  }
}

float LightDirections::jacobian(Vector3f world) const {
  if (keepsSolidAngles_) return 1;
  const float stretched = length(lightFromWorld_.vector(world));
  return inverseDeterminant_ / (stretched * stretched * stretched);
}

}  // namespace pbrtmedia
