// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "media/phase/phase_function.h"

namespace pbrtmedia {

/// Henyey & Greenstein 1941: p = (1 - g²) / (4 pi (1 + g² + 2 g dot(wo, wi))^(3/2)). Positive g scatters
/// forward (wi near -wo); g = 0 is isotropic. All terms are sums of like signs, so |g| near 1 keeps its
/// digits.
class HenyeyGreenstein final : public PhaseFunction {
 public:
  static constexpr std::string_view kTypeName = "henyey-greenstein";

  /// g in (-1, 1), the mean cosine; otherwise SceneError (location unknown).
  explicit HenyeyGreenstein(float g);

  float g() const { return g_; }
  std::string_view typeName() const override { return kTypeName; }
  float evaluate(Vector3f wo, Vector3f wi) const override;
  Sample sample(Vector3f wo, Point2f u) const override;

 private:
  float g_;
};

}  // namespace pbrtmedia
