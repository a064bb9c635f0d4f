// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/vec.h"

namespace pbrtmedia {

/// One row of a lens file: a spherical interface, or the aperture stop.
struct LensElement {
  double curvatureRadius = 0;  ///< metres, > 0: its centre lies toward the film; 0: the aperture stop
  double thickness = 0;        ///< metres to the next element toward the film, of the last one to the film
  double eta = 1;              ///< index of refraction between this element and the next one
  double apertureRadius = 0;   ///< metres
  bool isStop() const { return curvatureRadius == 0; }
};

/// A line in the space of the lens: the film lies at z = 0, the lens and the scene toward +z. Metres.
struct LensRay {
  Vec3d o, d;  ///< d: any length
};

/// Rays through a system of lenses about the z axis. Immutable, thread-safe.
/// Kolb, Mitchell & Hanrahan 1995, "A Realistic Camera Model for Computer Graphics".
class LensSystem {
 public:
  /// `elements`: front (toward the scene) to rear. Throws std::invalid_argument, naming row and column, for
  /// none, for numbers that are not finite, apertures not above 0 and indices not above 0.
  explicit LensSystem(std::vector<LensElement> elements);

  /// z of the rear element and of the front element.
  double rearZ() const { return elements_.back().thickness; }
  double frontZ() const { return frontZ_; }
  double rearApertureRadius() const { return elements_.back().apertureRadius; }

  /// The ray that leaves the front toward the scene, unit d; nothing when an aperture or total reflection
  /// stops it.
  std::optional<LensRay> traceFromFilm(LensRay ray) const;
  /// The ray that leaves the rear toward the film.
  std::optional<LensRay> traceFromScene(LensRay ray) const;

  /// The same lens, moved as a whole so that a plane `distance` metres from the film is sharp, by its thick
  /// lens approximation from rays at height `height` off the axis. Throws std::invalid_argument when there is
  /// no such place.
  LensSystem focusedAt(double distance, double height) const;

 private:
  /// Where an axis-parallel ray crosses the axis, and the plane where it seems to bend. PBRT-v3's signs: z
  /// grows from the scene to the film.
  struct Cardinal {
    double principal, focal;
  };
  static std::optional<Cardinal> cardinal(const LensRay& in, const std::optional<LensRay>& out);
  /// Moves the ray to the element at height z; false when it does not pass its aperture.
  static bool meets(const LensElement& element, double z, LensRay& ray, Vec3d& normal);

  std::vector<LensElement> elements_;
  double frontZ_ = 0;
};

}  // namespace pbrtmedia
