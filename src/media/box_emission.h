// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "media/emission_volume.h"

namespace pbrtmedia {

/// The same emission throughout a box.
class BoxEmission final : public EmissionVolume {
 public:
  /// Null when the box has no volume or no end. `emission`: sigma_a Le.
  static std::unique_ptr<const EmissionVolume> over(const Bounds3f& box, Rgb emission);

  Sample sample(const std::array<double, 3>& u) const override;
  double pdf(Point3f p) const override { return box_.contains(p) ? 1 / volume_ : 0; }
  Bounds3f bounds() const override { return box_; }
  Rgb total() const override { return emission_ * static_cast<float>(volume_); }

 private:
  BoxEmission(const Bounds3f& box, double volume, Rgb emission)
      : box_(box), volume_(volume), emission_(emission) {}
  Bounds3f box_;
  double volume_;
  Rgb emission_;
};

}  // namespace pbrtmedia
