// SPDX-License-Identifier: BSD-2-Clause
#include "textures/dots.h"

#include <cmath>

#include "base/math.h"
#include "textures/noise.h"

namespace pbrtmedia {

bool isInsideDot(Point2f st) {
  constexpr float kRadius = 0.35f, kMaxShift = 0.5f - kRadius;  // a dot never leaves its cell
  const float sCell = std::floor(st.x + 0.5f), tCell = std::floor(st.y + 0.5f);
  if (!(noise(sCell + 0.5f, tCell + 0.5f) > 0)) return false;
  const float sCentre = sCell + kMaxShift * noise(sCell + 1.5f, tCell + 2.8f);
  const float tCentre = tCell + kMaxShift * noise(sCell + 4.5f, tCell + 9.8f);
  return sqr(st.x - sCentre) + sqr(st.y - tCentre) < sqr(kRadius);
}

}  // namespace pbrtmedia
