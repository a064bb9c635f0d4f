// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "filters/filter.h"

namespace pbrtmedia {

/// PixelFilter "sinc": the Lanczos-windowed sinc(x) sinc(x/tau) sinc(y) sinc(y/tau), 0 outside of the radii;
/// sinc(t) = sin(pi t) / (pi t). Negative lobes.
class SincFilter final : public Filter {
 public:
  struct Params {
    Vector2f radius{4, 4};  ///< xwidth, ywidth: pixels, > 0
    float tau = 3;          ///< cycles until the window is 0, pixels, > 0
  };
  /// Throws SceneError when a radius is not in (0, 1000] or tau is not above 0.
  explicit SincFilter(const Params& params);
  float evaluate(Point2f offset) const override;

 private:
  float tau_;
};

}  // namespace pbrtmedia
