// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <string>

#include "base/transform.h"
#include "fields/density_function.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// A float texture as a density, evaluated at the point in world space: textures with a 3-D mapping vary with
/// it, those over (u, v) are looked up at (0, 0) everywhere. Knows no ranges. Values that are no density
/// (NaN, infinite, negative) count as 0 and are told of by `complaint`.
class TextureDensity final : public DensityFunction {
 public:
  /// `texture` must outlive it. `name`: for messages.
  TextureDensity(const FloatTexture& texture, std::string name, const Transform& worldFromMedium);

  float at(Vec3d p) const override;
  std::optional<Interval> range(const Bounds3d&) const override { return std::nullopt; }
  std::string describe() const override;
  std::string complaint() const override;

 private:
  const FloatTexture* texture_;
  std::string name_;
  Transform worldFromMedium_;
  mutable std::atomic<bool> sawNegative_{false}, sawNotFinite_{false};
};

}  // namespace pbrtmedia
