// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "filters/filter.h"

namespace pbrtmedia {

/// PixelFilter "mitchell": m(2|x|/rx) m(2|y|/ry) with the piecewise cubic m of Mitchell & Netravali 1988,
/// doi:10.1145/54852.378514, Eq. (8). Negative lobes.
class MitchellFilter final : public Filter {
 public:
  struct Params {
    Vector2f radius{2, 2};  ///< xwidth, ywidth: pixels, > 0
    float b = 1.0f / 3.0f;  ///< B and C; both 1/3 is the paper's recommendation
    float c = 1.0f / 3.0f;
  };
  /// Throws SceneError when a radius is not in (0, 1000] or B, C are not finite.
  explicit MitchellFilter(const Params& params);
  float evaluate(Point2f offset) const override;

 private:
  float b_, c_;
};

}  // namespace pbrtmedia
