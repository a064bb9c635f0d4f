// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "filters/filter.h"

namespace pbrtmedia {

/// PixelFilter "box": 1 everywhere. With radius 1/2 a pixel is the plain mean of its own samples.
class BoxFilter final : public Filter {
 public:
  struct Params {
    Vector2f radius{0.5f, 0.5f};  ///< xwidth, ywidth: pixels, > 0
  };
  /// Throws SceneError when a radius is not in (0, 1000].
  explicit BoxFilter(const Params& params);
  float evaluate(Point2f offset) const override;
};

}  // namespace pbrtmedia
