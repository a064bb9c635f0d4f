// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "base/rng.h"
#include "base/warp.h"
#include "image/image.h"
#include "lights/light.h"
#include "support/statistics.h"

namespace pbrtmedia::test {

inline constexpr Point2f kMiddle{0.5f, 0.5f};

/// Radiance, all three channels, to a relative tolerance of a few float roundings.
inline void expectRgb(Rgb found, Rgb expected, float relative = 1e-5f) {
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(found[c], expected[c], relative * std::abs(expected[c]) + 1e-12f)
        << found << " instead of " << expected;
  }
}

/// A picture of width x height whose pixels are colour(x, y), y = 0 on top.
inline Image makePicture(int width, int height, const std::function<Rgb(int, int)>& colour) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.setRgb(x, y, colour(x, y));
  }
  return image;
}

/// Irradiance at `p` on a surface with unit normal `n`: the mean over light samples. Red channel.
inline RunningStats irradianceByLight(const Light& light, Point3f p, Normal3f n, std::uint64_t seed,
                                      int count) {
  Rng rng(seed);
  RunningStats stats;
  for (int i = 0; i < count; ++i) {
    const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
    stats.add(s.pdf > 0 ? double{s.radiance.r} * std::max(0.0f, dot(n, s.wi)) / s.pdf : 0.0);
  }
  return stats;
}

/// The same for lights at infinity, by directions uniform on the sphere: knows nothing of the light's
/// sampling.
inline RunningStats irradianceByDirection(const Light& light, Normal3f n, std::uint64_t seed, int count) {
  Rng rng(seed);
  RunningStats stats;
  for (int i = 0; i < count; ++i) {
    const Vector3f wi = sampleUniformSphere({rng.uniform(), rng.uniform()});
    stats.add(double{light.background(wi).r} * std::max(0.0f, dot(n, wi)) / pdfUniformSphere());
  }
  return stats;
}

}  // namespace pbrtmedia::test
