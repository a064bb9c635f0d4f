// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/math.h"

namespace pbrtmedia {

/// "name: expected ..., found value" as std::invalid_argument.
template <class T>
[[noreturn]] void rejectParameter(std::string_view name, std::string_view expected, const T& found) {
  std::ostringstream message;
  message << name << ": expected " << expected << ", found " << found;
  throw std::invalid_argument(message.str());
}
inline void requirePositive(std::string_view name, float value) {
  if (!(value > 0 && value < kInfinity)) rejectParameter(name, "a finite number > 0", value);
}
inline void requireFinite(std::string_view name, float value) {
  if (!std::isfinite(value)) rejectParameter(name, "a finite number", value);
}
/// `phimax` in degrees, clamped to [0, 360], as radians; an empty sweep is rejected.
inline double sweepAngle(float phimax) {
  if (!(phimax > 0)) rejectParameter("phimax", "degrees > 0", phimax);
  return radians(std::min(static_cast<double>(phimax), 360.0));
}

}  // namespace pbrtmedia
