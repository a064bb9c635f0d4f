// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "media/phase/phase_function.h"

namespace pbrtmedia {

/// Scattering by particles much smaller than the wavelength: p = 3 (1 + dot(wo, wi)²) / (16 pi). Rayleigh
/// 1871. Sampled exactly, by the one real root of its distribution function's cubic.
class Rayleigh final : public PhaseFunction {
 public:
  static constexpr std::string_view kTypeName = "rayleigh";

  std::string_view typeName() const override { return kTypeName; }
  float evaluate(Vector3f wo, Vector3f wi) const override;
  Sample sample(Vector3f wo, Point2f u) const override;
};

}  // namespace pbrtmedia
