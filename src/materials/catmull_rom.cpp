// SPDX-License-Identifier: BSD-2-Clause
#include "materials/catmull_rom.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {
namespace {

/// The piece from node i to i + 1, over t in [0, 1]; slopes are per piece.
struct Piece {
  float x0, width, f0, f1, d0, d1;

  float value(float t) const {
    return f0 + t * (d0 + t * (-2 * d0 - d1 + 3 * (f1 - f0) + t * (d0 + d1 + 2 * (f0 - f1))));
  }
  float slope(float t) const {
    return d0 + t * (2 * (-2 * d0 - d1 + 3 * (f1 - f0)) + 3 * t * (d0 + d1 + 2 * (f0 - f1)));
  }
  /// Integral from 0 to t, per width.
  float integral(float t) const {
    return t * (f0 + t * (0.5f * d0 +
                          t * ((-2 * d0 - d1) / 3 + f1 - f0 + t * (0.25f * (d0 + d1) + 0.5f * (f0 - f1)))));
  }
};

Piece pieceAt(std::span<const float> x, std::span<const float> f, std::size_t i) {
  const float width = x[i + 1] - x[i], chord = f[i + 1] - f[i];
  const float d0 = i > 0 ? width * (f[i + 1] - f[i - 1]) / (x[i + 1] - x[i - 1]) : chord;
  const float d1 = i + 2 < x.size() ? width * (f[i + 2] - f[i]) / (x[i + 2] - x[i]) : chord;
  return {x[i], width, f[i], f[i + 1], d0, d1};
}

/// The last i with list[i] <= x, so that i + 1 is in the list too.
std::size_t pieceIndex(std::span<const float> list, float x) {
  const auto above = std::upper_bound(list.begin(), list.end(), x);
  const auto i = std::max<std::ptrdiff_t>(1, above - list.begin()) - 1;
  return std::min(static_cast<std::size_t>(i), list.size() - 2);
}

/// Where a function with value(0) <= target <= value(1) takes that value: Newton's steps, halving where they
/// leave the bracket.
template <class Value, class Slope>
float solve(const Value& value, const Slope& slope, float target, float guess) {
  constexpr int kSteps = 60;
  constexpr float kWidth = 1e-6f;
  float lo = 0, hi = 1, t = std::clamp(guess, 0.0f, 1.0f);
  for (int i = 0; i < kSteps; ++i) {
    if (!(t > lo && t < hi)) t = 0.5f * (lo + hi);
    const float off = value(t) - target;
    if (off == 0) return t;
    (off < 0 ? lo : hi) = t;
    if (hi - lo < kWidth) break;
    const float next = t - off / slope(t);
    if (std::abs(next - t) < kWidth * 0.1f && next > lo && next < hi) return next;
    t = next;
  }
  return 0.5f * (lo + hi);
}

}  // namespace

std::optional<SplineWeights> splineWeights(std::span<const float> x, float at) {
  if (!(at >= x.front() && at <= x.back())) return std::nullopt;
  const std::size_t i = pieceIndex(x, at);
  const float width = x[i + 1] - x[i], t = (at - x[i]) / width, t2 = t * t, t3 = t2 * t;
  const float ofSlope0 = t3 - 2 * t2 + t, ofSlope1 = t3 - t2, ofValue1 = 3 * t2 - 2 * t3;
  SplineWeights w{static_cast<std::ptrdiff_t>(i) - 1, {0, 1 - ofValue1, ofValue1, 0}};
  const auto add = [&](float ofSlope, std::size_t from, std::size_t to) {
    const float share = ofSlope * width / (x[to] - x[from]);
    w.weight[to + 1 - i] += share;
    w.weight[from + 1 - i] -= share;
  };
  add(ofSlope0, i > 0 ? i - 1 : i, i + 1);
  add(ofSlope1, i, i + 2 < x.size() ? i + 2 : i + 1);
  return w;
}

float integrateSpline(std::span<const float> x, std::span<const float> f, std::span<float> cumulative) {
  double sum = 0;
  cumulative[0] = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const Piece p = pieceAt(x, f, i);
    sum += static_cast<double>(p.width) * static_cast<double>(p.integral(1));
    cumulative[i + 1] = static_cast<float>(sum);
  }
  return cumulative.back();
}

float invertSpline(std::span<const float> x, std::span<const float> f, float value) {
  if (!(value > f.front())) return x.front();
  if (value >= f.back()) return x.back();
  const Piece p = pieceAt(x, f, pieceIndex(f, value));
  const float t = solve([&](float s) { return p.value(s); }, [&](float s) { return p.slope(s); }, value,
                        (value - p.f0) / (p.f1 - p.f0));
  return p.x0 + p.width * t;
}

float sampleSpline(std::span<const float> x, std::span<const float> f, std::span<const float> cumulative,
                   float u) {
  const float target = u * cumulative.back();
  const std::size_t i = pieceIndex(cumulative, target);
  const Piece p = pieceAt(x, f, i);
  const float rest = (target - cumulative[i]) / p.width;
  // A first guess from the straight line between the two values.
  const float mean = 0.5f * (p.f0 + p.f1);
  const float t = solve([&](float s) { return p.integral(s); }, [&](float s) { return p.value(s); }, rest,
                        mean > 0 ? rest / mean : 0.5f);
  return p.x0 + p.width * t;
}

}  // namespace pbrtmedia
