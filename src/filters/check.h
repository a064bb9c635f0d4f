// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <sstream>
#include <string_view>

#include "base/diagnostics.h"
#include "base/vec.h"

namespace pbrtmedia {

/// SceneError unless `ok`; the message names the filter, the parameter and the value found.
template <class T>
void requireFilterParameter(bool ok, std::string_view filter, std::string_view name, const T& found,
                            std::string_view expected) {
  if (ok) return;
  std::ostringstream text;
  text << "pixel filter \"" << filter << "\": " << name << " is " << found << "; expected " << expected;
  throw SceneError({}, text.str());
}

inline Vector2f checkedRadius(std::string_view filter, Vector2f radius) {
  // Wider filters would need more samples around the film than any image has.
  constexpr float kMost = 1000;
  const auto good = [&](float r) { return r > 0 && r <= kMost; };
  requireFilterParameter(good(radius.x), filter, "xwidth", radius.x, "a radius in (0, 1000] pixels");
  requireFilterParameter(good(radius.y), filter, "ywidth", radius.y, "a radius in (0, 1000] pixels");
  return radius;
}

}  // namespace pbrtmedia
