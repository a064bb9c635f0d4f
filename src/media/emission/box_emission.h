// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "media/emission/emission_volume.h"

namespace pbrtmedia {

/// The same emission throughout a box.
class BoxEmission final : public EmissionVolume {
 public:
  /// Null when the box has no volume or no end. `emission`: sigma_a Le.
  static std::unique_ptr<const EmissionVolume> over(const Bounds3f& box, Rgb emission, Rgb sigmaT);

  Point3f sample(const std::array<double, 3>& u) const override;
  double density(Point3f p) const override;
  double directionDensity(const Segment& line) const override;
  Bounds3f bounds() const override { return box_; }
  Rgb total() const override { return total_; }

 private:
  BoxEmission(const Bounds3f& box, double volume, Rgb total) : box_(box), volume_(volume), total_(total) {}
  Bounds3f box_;
  double volume_;
  Rgb total_;
};

}  // namespace pbrtmedia
