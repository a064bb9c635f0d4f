// SPDX-License-Identifier: BSD-2-Clause
#include "textures/checkerboard.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {

namespace {

/// 0 or 1; in floating point, so that no coordinate is too large.
float parity(float x) {
  const float n = std::floor(x);
  return n - 2 * std::floor(0.5f * n);
}

/// Integral from 0 to x of the step function that is 1 on odd checks.
float oddLength(float x) {
  const float half = 0.5f * x, whole = std::floor(half);
  return whole + 2 * std::max(half - whole - 0.5f, 0.0f);
}

/// Share of odd checks in [x - d, x + d].
float oddShare(float x, float d) {
  if (std::floor(x - d) == std::floor(x + d)) return parity(x);
  return std::clamp((oddLength(x + d) - oddLength(x - d)) / (2 * d), 0.0f, 1.0f);
}

}  // namespace

float checkerboardShare(const TexCoord2& at, CheckerboardFilter filter) {
  const auto [s, t] = at.st;
  const float pointShare = parity(s) == parity(t) ? 0.0f : 1.0f;
  if (filter == CheckerboardFilter::None) return pointShare;
  const float ds = std::max(std::abs(at.dstdx.x), std::abs(at.dstdy.x));
  const float dt = std::max(std::abs(at.dstdx.y), std::abs(at.dstdy.y));
  if (std::floor(s - ds) == std::floor(s + ds) && std::floor(t - dt) == std::floor(t + dt)) return pointShare;
  if (ds > 1 || dt > 1) return 0.5f;
  const float a = oddShare(s, ds), b = oddShare(t, dt);
  return a + b - 2 * a * b;  // exactly one of the two is odd
}

bool isOddCheck(Point3f p) { return (parity(p.x) != parity(p.y)) != (parity(p.z) != 0); }

}  // namespace pbrtmedia
