// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "filters/filter.h"

namespace pbrtmedia {

/// PixelFilter "gaussian": g(x) g(y) with g(d) = max(0, exp(-alpha d^2) - exp(-alpha r^2)).
class GaussianFilter final : public Filter {
 public:
  struct Params {
    Vector2f radius{2, 2};  ///< xwidth, ywidth: pixels, > 0
    float alpha = 2;        ///< falloff, 1/pixel^2, > 0
  };
  /// Throws SceneError when a radius is not in (0, 1000] or alpha is not above 0.
  explicit GaussianFilter(const Params& params);
  float evaluate(Point2f offset) const override;

 private:
  float alpha_;
  double edgeX_, edgeY_;  ///< exp(-alpha r^2)
};

}  // namespace pbrtmedia
