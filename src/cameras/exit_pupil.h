// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "cameras/lens_system.h"

namespace pbrtmedia {

/// Through which part of the plane of the rear element light reaches the film: a rectangle for each of
/// `kZones` distances from the centre of the film, in the frame whose x axis points to the film point.
///
/// The zone at the centre is bounded as in PBRT-v3, from the same 2^20 points and with the same margin, since
/// images under simple weighting are in proportion to its area. Of the others only the noise depends on how
/// tight they are: they are found with fewer points, in two steps.
class ExitPupil {
 public:
  static constexpr std::size_t kZones = 64;
  struct Rectangle {
    Point2d min, max;  ///< metres, on the plane z = rearZ
    double area() const { return (max.x - min.x) * (max.y - min.y); }
  };
  /// `filmRadius`: half the diagonal, metres. On all threads; the result does not depend on how many.
  ExitPupil(const LensSystem& lens, double filmRadius);

  /// Of the zone of a film point that far from the centre; beyond `filmRadius` that of the last zone.
  const Rectangle& at(double distance) const;
  double centralArea() const { return zones_.front().area(); }

 private:
  double filmRadius_;
  std::vector<Rectangle> zones_;
};

}  // namespace pbrtmedia
