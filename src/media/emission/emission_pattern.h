// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// What the emitted radiance Le of a medium is multiplied with from place to place. World space of the
/// medium's definition. Immutable, thread-safe.
class EmissionPattern {
 public:
  virtual ~EmissionPattern() = default;
  /// >= 0, finite.
  virtual Rgb at(Vec3d p) const = 0;
  /// A bound on every channel of `at` over the convex hull of the corners of a cell; 0 only where all are.
  virtual float upperOver(const std::array<Vec3d, 8>& corners) const = 0;
  /// Whether it is 0 everywhere.
  virtual bool isBlack() const = 0;
  virtual std::string describe() const = 0;
  virtual std::size_t bytes() const = 0;
};

}  // namespace pbrtmedia
