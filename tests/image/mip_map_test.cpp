// SPDX-License-Identifier: BSD-2-Clause
#include "image/mip_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/math.h"
#include "base/rng.h"

namespace pbrtmedia {
namespace {

constexpr WrapMode kWraps[] = {WrapMode::Repeat, WrapMode::Black, WrapMode::Clamp};

std::vector<float> randomTexels(int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<float> texels;
  for (int i = 0; i < count; ++i) texels.push_back(rng.uniform());
  return texels;
}

TEST(MipMap, KeepsTexelsOfPowerOfTwoImages) {
  const MipMap<float> map(4, 2, {1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(map.width(), 4);
  EXPECT_EQ(map.height(), 2);
  EXPECT_EQ(map.levelCount(), 3);
  EXPECT_EQ(map.texel(0, 1, 0), 2);
  EXPECT_EQ(map.texel(0, 3, 1), 8);
  EXPECT_EQ(map.texel(1, 0, 0), 3.5f);  // (1 + 2 + 5 + 6) / 4
  EXPECT_EQ(map.texel(1, 1, 0), 5.5f);
  EXPECT_EQ(map.coarsest(), 4.5f);  // a side of one texel is its own neighbour
}

TEST(MipMap, ReadsTexelCentresExactlyAndInterpolatesBetween) {
  const MipMap<float> map(4, 2, {1, 2, 3, 4, 5, 6, 7, 8}, WrapMode::Clamp);
  EXPECT_EQ(map.bilinear({0.125f, 0.25f}), 1);
  EXPECT_EQ(map.bilinear({0.875f, 0.75f}), 8);
  EXPECT_EQ(map.bilinear({0.25f, 0.25f}), 1.5f);
  EXPECT_EQ(map.bilinear({0.25f, 0.5f}), 3.5f);
  EXPECT_EQ(map.bilinear({0.5f, 0.5f}, 1), 4.5f);
}

TEST(MipMap, AnswersOutsideByItsWrapMode) {
  const std::vector<float> texels{1, 2, 3, 4, 5, 6, 7, 8};
  const MipMap<float> repeat(4, 2, texels, WrapMode::Repeat), black(4, 2, texels, WrapMode::Black),
      clamp(4, 2, texels, WrapMode::Clamp);
  EXPECT_EQ(repeat.texel(0, -1, 0), 4);
  EXPECT_EQ(repeat.texel(0, 9, -3), 6);
  EXPECT_EQ(black.texel(0, -1, 0), 0);
  EXPECT_EQ(black.texel(0, 0, 2), 0);
  EXPECT_EQ(clamp.texel(0, -7, 1), 5);
  EXPECT_EQ(clamp.texel(0, 9, 5), 8);
  EXPECT_EQ(repeat.bilinear({1.125f, -0.75f}), 1);
  EXPECT_EQ(repeat.bilinear({0, 0.25f}), 2.5f);  // between the last and the first column
  EXPECT_EQ(clamp.bilinear({-3, 0.25f}), 1);
  EXPECT_EQ(clamp.bilinear({17, 17}), 8);
  EXPECT_EQ(black.bilinear({-3, 0.25f}), 0);
  EXPECT_EQ(black.bilinear({0, 0.25f}), 0.5f);
}

TEST(MipMap, KeepsConstantsExactlyWhenItResamples) {
  for (const WrapMode wrap : {WrapMode::Repeat, WrapMode::Clamp}) {
    for (const auto& [w, h] : {std::pair{3, 5}, std::pair{1, 7}, std::pair{100, 64}, std::pair{33, 1}}) {
      const float value = 0.3f;
      const MipMap<float> map(w, h, std::vector<float>(static_cast<std::size_t>(w * h), value), wrap);
      for (int level = 0; level < map.levelCount(); ++level) {
        for (int x = 0; x < map.width() >> level; ++x) ASSERT_EQ(map.texel(level, x, 0), value);
      }
      EXPECT_EQ(map.texel(0, 0, map.height() - 1), value);
      EXPECT_EQ(map.coarsest(), value);
    }
  }
}

TEST(MipMap, ResamplesUpToPowersOfTwo) {
  const MipMap<float> map(5, 3, std::vector<float>(15, 1.0f));
  EXPECT_EQ(map.width(), 8);
  EXPECT_EQ(map.height(), 4);
  EXPECT_EQ(map.levelCount(), 4);
}

TEST(MipMap, ResamplesByTheLanczosFilter) {
  const auto sinc = [](double x) {
    return x == 0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
  };
  const std::vector<float> in = randomTexels(6, 5);
  for (const WrapMode wrap : kWraps) {
    const MipMap<float> map(6, 1, in, wrap);
    for (int i = 0; i < 8; ++i) {
      const double centre = (i + 0.5) * 6 / 8;
      double sum = 0, weights = 0;
      for (int j = -3; j < 9; ++j) {
        const double d = j + 0.5 - centre;
        if (std::abs(d) >= 2) continue;
        const double weight = sinc(d) * sinc(d / 2);
        weights += weight;
        const bool isInside = j >= 0 && j < 6;
        const int index = wrap == WrapMode::Repeat ? (j + 6) % 6 : std::clamp(j, 0, 5);
        if (isInside || wrap != WrapMode::Black)
          sum += weight * static_cast<double>(in[static_cast<std::size_t>(index)]);
      }
      EXPECT_NEAR(map.texel(0, i, 0), std::max(0.0, sum / weights), 1e-5) << i;
    }
  }
}

TEST(MipMap, ClampsTheUndershootOfTheFilterAtZero) {
  const MipMap<Rgb> map(6, 1, {Rgb(0), Rgb(0), Rgb(0), Rgb(0, 9, 9), Rgb(0, 9, 9), Rgb(0)});
  bool hasZero = false;
  for (int x = 0; x < 8; ++x) {
    EXPECT_GE(map.texel(0, x, 0).min(), 0);
    hasZero = hasZero || map.texel(0, x, 0).g == 0;
  }
  EXPECT_TRUE(hasZero);
}

TEST(MipMap, TrilinearPicksTheLevelByTheWidth) {
  const MipMap<float> map(8, 8, randomTexels(64, 6));
  const Point2f st{0.31f, 0.67f};
  EXPECT_EQ(map.trilinear(st, 0), map.bilinear(st));
  EXPECT_EQ(map.trilinear(st, 0.125f), map.bilinear(st));
  EXPECT_EQ(map.trilinear(st, 0.25f), map.bilinear(st, 1));
  EXPECT_EQ(map.trilinear(st, 0.5f), map.bilinear(st, 2));
  EXPECT_EQ(map.trilinear(st, 1), map.coarsest());
  EXPECT_EQ(map.trilinear(st, 100), map.coarsest());
  EXPECT_NEAR(map.trilinear(st, std::exp2(-1.75f)), 0.75f * map.bilinear(st, 1) + 0.25f * map.bilinear(st, 2),
              1e-6f);
}

TEST(MipMap, EwaIsBilinearWithoutAFootprint) {
  const MipMap<float> map(8, 8, randomTexels(64, 7));
  const Point2f st{0.31f, 0.67f};
  EXPECT_EQ(map.ewa(st, {0, 0}, {0, 0}, 8), map.bilinear(st));
  EXPECT_EQ(map.ewa(st, {0.5f, 0}, {0, 0}, 8), map.bilinear(st));
  EXPECT_EQ(map.ewa(st, {0, 1}, {2, 0}, 8), map.coarsest());
}

/// The Gaussian of the ellipse with axes a0, a1 (texels, one texel added in every direction), over all texels
/// of nine periods: r² = dᵀ (a0 a0ᵀ + a1 a1ᵀ + 1)⁻¹ d.
double bruteForceEwa(const MipMap<float>& map, int level, Point2f st, Vector2f axis0, Vector2f axis1) {
  const double w = map.width() >> level, h = map.height() >> level;
  const double x0 = double{axis0.x} * w, y0 = double{axis0.y} * h, x1 = double{axis1.x} * w,
               y1 = double{axis1.y} * h;
  const double xx = x0 * x0 + x1 * x1 + 1, yy = y0 * y0 + y1 * y1 + 1, xy = x0 * y0 + x1 * y1;
  const double det = xx * yy - xy * xy;
  double sum = 0, weights = 0;
  for (int y = -static_cast<int>(h); y < 2 * h; ++y) {
    for (int x = -static_cast<int>(w); x < 2 * w; ++x) {
      const double dx = x - (double{st.x} * w - 0.5), dy = y - (double{st.y} * h - 0.5);
      const double r2 = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / det;
      if (r2 >= 1) continue;
      const double weight = std::exp(-2 * r2) - std::exp(-2.0);
      sum += weight * static_cast<double>(map.texel(level, x, y));
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(MipMap, EwaEqualsBruteForceOnEveryWrapMode) {
  for (const WrapMode wrap : kWraps) {
    const MipMap<float> map(32, 16, randomTexels(32 * 16, 8), wrap);
    Rng rng(9);
    for (int i = 0; i < 50; ++i) {
      const Point2f st{rng.uniform(), rng.uniform()};
      const float angle = 7 * rng.uniform(), length = 0.0625f * std::exp2(-static_cast<float>(i % 3));
      const Vector2f minor{length * std::cos(angle), length * std::sin(angle)};
      const Vector2f major{-3 * minor.y, 3 * minor.x};
      // log2: levels 0 to 5 in all; minor axis 2^-4 2^-5 2^-6 of the image: levels 1, 0 and (clamped) 0.
      const int level = i % 3 == 0 ? 1 : 0;
      const double expected = bruteForceEwa(map, level, st, major, minor);
      // At a whole level the blend may round to a little of the next one.
      EXPECT_NEAR(map.ewa(st, major, minor, 8), expected, 2e-4) << st << major << minor;
      EXPECT_NEAR(map.ewa(st, minor, major, 8), expected, 2e-4) << "the order of the axes must not matter";
    }
  }
}

TEST(MipMap, EwaBlendsTwoLevels) {
  const MipMap<float> map(32, 32, randomTexels(1024, 10));
  const float length = std::exp2(-3.75f);  // level 1.25
  const Vector2f major{2 * length, 0}, minor{0, length};
  const Point2f st{0.4f, 0.6f};
  EXPECT_NEAR(map.ewa(st, major, minor, 8),
              0.75 * bruteForceEwa(map, 1, st, major, minor) + 0.25 * bruteForceEwa(map, 2, st, major, minor),
              1e-4);
}

TEST(MipMap, EwaWidensThinEllipses) {
  const MipMap<float> map(32, 32, randomTexels(1024, 11));
  const Point2f st{0.4f, 0.6f};
  EXPECT_NEAR(map.ewa(st, {0.25f, 0}, {0, 0.001f}, 4), map.ewa(st, {0.25f, 0}, {0, 0.0625f}, 4), 1e-6f);
  EXPECT_NEAR(map.ewa(st, {0.25f, 0}, {0, 0.001f}, 1), map.ewa(st, {0.25f, 0}, {0, 0.25f}, 1), 1e-6f);
}

TEST(MipMap, SurvivesNonFiniteAndHugeCoordinates) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const WrapMode wrap : kWraps) {
    const MipMap<float> map(8, 4, randomTexels(32, 12), wrap);
    for (const float bad : {nan, kInfinity, -kInfinity, 1e30f, -3e9f}) {
      EXPECT_TRUE(std::isfinite(map.bilinear({bad, 0.5f})));
      EXPECT_TRUE(std::isfinite(map.bilinear({0.5f, bad})));
      EXPECT_TRUE(std::isfinite(map.trilinear({0.5f, bad}, 0.3f)));
      EXPECT_TRUE(std::isfinite(map.trilinear({0.5f, 0.5f}, bad)));
      EXPECT_TRUE(std::isfinite(map.ewa({bad, 0.5f}, {0.1f, 0}, {0, 0.1f}, 8)));
      EXPECT_TRUE(std::isfinite(map.ewa({0.5f, 0.5f}, {bad, 0}, {0, 0.1f}, 8)));
      EXPECT_TRUE(std::isfinite(map.ewa({0.5f, 0.5f}, {0.1f, 0}, {0, bad}, 1024)));
    }
  }
}

TEST(MipMap, RefusesACountThatDoesNotFit) {
  EXPECT_THROW(MipMap<float>(2, 2, {1, 2, 3}), std::invalid_argument);
  EXPECT_THROW(MipMap<float>(0, 2, {}), std::invalid_argument);
  EXPECT_THROW(MipMap<float>(-1, -1, {1}), std::invalid_argument);
}

TEST(MakeLightMap, HasTheTopRowAtTZeroAndDecodesNothing) {
  Image image(2, 2);
  image.setRgb(0, 0, {0.5f, 1, 2});
  image.setRgb(1, 1, {4, 5, 6});
  const MipMap<Rgb> map = makeLightMap(image);
  EXPECT_EQ(map.bilinear({0.25f, 0.25f}), Rgb(0.5f, 1, 2));
  EXPECT_EQ(map.bilinear({0.75f, 0.75f}), Rgb(4, 5, 6));
  EXPECT_EQ(map.coarsest(), Rgb(1.125f, 1.5f, 2));
}

}  // namespace
}  // namespace pbrtmedia
