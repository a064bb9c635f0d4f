// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"

namespace pbrtmedia {

/// A pixel reconstruction filter, separable or not. Radii in pixels (half-widths). Immutable.
class Filter {
 public:
  virtual ~Filter() = default;
  /// Value at an offset from the centre, |x| <= radius.x, |y| <= radius.y; may be negative.
  virtual float evaluate(Point2f offset) const = 0;
  Vector2f radius() const { return radius_; }

 protected:
  explicit Filter(Vector2f radius) : radius_(radius) {}

 private:
  Vector2f radius_;
};

}  // namespace pbrtmedia
