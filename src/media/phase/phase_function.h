// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "base/vec.h"

namespace pbrtmedia {

/// Angular distribution of scattering; integrates to 1 over the sphere. Both directions point away from the
/// scattering point (wo toward where the path came from), so forward scattering is dot(wo, wi) = -1.
/// Immutable, thread-safe.
class PhaseFunction {
 public:
  virtual ~PhaseFunction() = default;
  virtual std::string_view typeName() const = 0;
  /// Value in 1/sr, equal to the sampling density.
  virtual float evaluate(Vector3f wo, Vector3f wi) const = 0;
  struct Sample {
    Vector3f wi;      ///< unit
    float value = 0;  ///< evaluate(wo, wi) = pdf
  };
  virtual Sample sample(Vector3f wo, Point2f u) const = 0;
};

}  // namespace pbrtmedia
