// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/image.h"

namespace pbrtmedia::test {

/// What rounding may do to an image of something that shines through an absorber. No sample of it is random.
struct DimmingTolerance {
  double ofDepth = 1e-6;     ///< of the optical depth: float vertices, hits, coefficients, sums of pieces
  double ofValue = 0x1p-22;  ///< of the transmittance: float radiance, a weighted mean, a float pixel
  double absolute = std::numeric_limits<float>::min();  ///< smaller values lose their digits
};

/// Whether every value of an image is `unattenuated` dimmed by exp(-opticalDepth). A depth that is missing is
/// seen down to 3e-7, transmittance that is missing up to depth 87, where floats end.
inline testing::AssertionResult dimsTo(const Image& image, double opticalDepth, double unattenuated = 1,
                                       const DimmingTolerance& tolerance = {}) {
  const double truth = unattenuated * std::exp(-opticalDepth);
  const double relative = std::expm1(tolerance.ofDepth * opticalDepth) + tolerance.ofValue;
  const double allowed = relative * truth + tolerance.absolute;
  double worst = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = static_cast<double>(image.at(x, y, c)) - truth;
        if (!(std::abs(error) <= std::abs(worst))) worst = error;
      }
    }
  }
  auto result = std::abs(worst) <= allowed ? testing::AssertionSuccess() : testing::AssertionFailure();
  return result << "optical depth " << opticalDepth << ": expected " << truth << " +- " << allowed
                << ", found a pixel that is off by " << worst << " (" << worst / truth << " of it)";
}

}  // namespace pbrtmedia::test
