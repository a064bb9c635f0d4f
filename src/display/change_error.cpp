// SPDX-License-Identifier: BSD-2-Clause
#include "display/change_error.h"

#include <cmath>

namespace pbrtmedia {

std::optional<double> errorFromChange(const Image& before, double samplesBefore, const Image& after,
                                      double samples) {
  const bool isComparable = before.width() == after.width() && before.height() == after.height() &&
                            before.hasRgb() && after.hasRgb();
  if (!isComparable || after.data().empty() || !(samplesBefore > 0) || !(samples > samplesBefore))
    return std::nullopt;
  double sum = 0;
  for (int y = 0; y < after.height(); ++y) {
    for (int x = 0; x < after.width(); ++x) {
      const Rgb change = after.rgb(x, y) - before.rgb(x, y);
      for (const float c : {change.r, change.g, change.b}) sum += static_cast<double>(c) * c;
    }
  }
  const double meanSquare = sum / (3.0 * after.width() * after.height());
  return std::sqrt(meanSquare / (1 / samplesBefore - 1 / samples) / samples);
}

}  // namespace pbrtmedia
