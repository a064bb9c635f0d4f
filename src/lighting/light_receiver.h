// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"

namespace pbrtmedia {

class PhaseFunction;

/// Where light is to arrive and be scattered, as far as the choice of a light looks at it. World space.
struct LightReceiver {
  /// A point that is lit from all around.
  LightReceiver(Point3f point) : p(point) {}  // NOLINT(google-explicit-constructor): that is what a point is

  Point3f p;
  Vector3f n{};   ///< unit, toward the side of a surface that is lit; 0: lit from all around
  Vector3f wo{};  ///< unit, toward where the path came from; where there is a phase function
  const PhaseFunction* phase = nullptr;  ///< null: a surface, or one does not know
  /// Whoever scatters there finds uniform infinite lights by directions alone (Illuminant::isUniformInfinite)
  /// and drops a sample of them: selectors may leave them out.
  bool findsUniformLights = false;
};

}  // namespace pbrtmedia
