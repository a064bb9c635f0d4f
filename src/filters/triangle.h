// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "filters/filter.h"

namespace pbrtmedia {

/// PixelFilter "triangle": (rx - |x|)(ry - |y|), 0 outside.
class TriangleFilter final : public Filter {
 public:
  struct Params {
    Vector2f radius{2, 2};  ///< xwidth, ywidth: pixels, > 0
  };
  /// Throws SceneError when a radius is not in (0, 1000].
  explicit TriangleFilter(const Params& params);
  float evaluate(Point2f offset) const override;
};

}  // namespace pbrtmedia
