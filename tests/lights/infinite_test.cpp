// SPDX-License-Identifier: BSD-2-Clause
#include "lights/infinite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "lights/light_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectRgb;
using test::kMaxAbsZ;
using test::kMinPValue;
using test::makePicture;
using test::zTest;

constexpr Point3f kAnywhere{3, -1, 2};

/// 8 x 4 texels, every one different, none black.
Image gradient() {
  return makePicture(8, 4, [](int x, int y) { return Rgb(1.0f + x, 1.0f + 3 * y, 0.5f); });
}

/// Black but for one texel: a sun.
Image sun(int width, int height, int sunX, int sunY) {
  return makePicture(width, height,
                     [=](int x, int y) { return Rgb(x == sunX && y == sunY ? 1000.0f : 0.0f); });
}

/// Light-space direction of map coordinates, by the formula of the scene language.
Vector3f direction(double u, double v) {
  const double theta = std::numbers::pi * v, phi = 2 * std::numbers::pi * u;
  return Vector3f(Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
}

const Transform kTurned = Transform::rotate(-90, {1, 0, 0}) * Transform::rotate(37, {1, 2, 3});

TEST(InfiniteLight, IsTheSameEverywhereWithoutAMap) {
  const InfiniteLight light(kTurned, {.radiance = {1, 2, 3}, .samples = 4});
  EXPECT_FALSE(light.isDelta());
  EXPECT_TRUE(light.isInfinite());
  EXPECT_EQ(light.sampleCount(), 4);
  const LightSample s = light.sample(kAnywhere, {0.3f, 0.8f});
  EXPECT_EQ(s.radiance, (Rgb{1, 2, 3}));
  EXPECT_EQ(s.distance, kInfinity);
  EXPECT_EQ(s.pdf, kInv4Pi);
  EXPECT_EQ(light.pdf(kAnywhere, s.wi, nullptr), kInv4Pi);
  EXPECT_EQ(light.background(-s.wi), (Rgb{1, 2, 3}));
}

TEST(InfiniteLight, HasItsTopRowAtPlusZAndItsLeftEdgeAtPlusXTurningTowardPlusY) {
  const InfiniteLight light(Transform(), {.radiance = Rgb(2), .map = gradient()});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      expectRgb(light.background(direction((x + 0.5) / 8, (y + 0.5) / 4)), Rgb(2.0f + 2 * x, 2.0f + 6 * y, 1),
                1e-4f);
    }
  }
  // Columns: +x between 7 and 0, +y between 1 and 2, -x between 3 and 4, -y between 5 and 6.
  EXPECT_NEAR(light.background({1, 0, 0}).r, 2 * 4.5f, 1e-4f);
  EXPECT_NEAR(light.background({0, 1, 0}).r, 2 * 2.5f, 1e-4f);
  EXPECT_NEAR(light.background({-1, 0, 0}).r, 2 * 4.5f, 1e-4f);
  EXPECT_NEAR(light.background({0, -1, 0}).r, 2 * 6.5f, 1e-4f);
}

TEST(InfiniteLight, RepeatsAcrossThePolesAndTheSeam) {
  // "Repeat in both directions": at the pole the top row blends with the bottom row.
  const InfiniteLight light(Transform(), {.map = gradient()});
  EXPECT_NEAR(light.background({0, 0, 1}).g, (1 + 10) / 2.0f, 1e-4f);
  EXPECT_NEAR(light.background({0, 0, -1}).g, (1 + 10) / 2.0f, 1e-4f);
  const float below = light.background(direction(1 - 1e-6, 0.4)).r;
  EXPECT_NEAR(light.background(direction(1e-6, 0.4)).r, below, 1e-3f);
}

TEST(InfiniteLight, FollowsTheTransform) {
  const InfiniteLight light(Transform::rotate(-90, {1, 0, 0}), {.map = gradient()});  // the usual y-up scene
  const InfiniteLight plain(Transform(), {.map = gradient()});
  const Transform turn = Transform::rotate(-90, {1, 0, 0});
  for (const Point2f uv : {Point2f{0.1f, 0.2f}, Point2f{0.6f, 0.7f}, Point2f{0.9f, 0.05f}}) {
    const Vector3f w = direction(uv.x, uv.y);
    expectRgb(light.background(turn.vector(w)), plain.background(w), 1e-4f);
  }
  EXPECT_GT(turn.vector(Vector3f{0, 0, 1}).y, 0.99f) << "light-space +z becomes up";
}

/// Density, radiance and direction of a sample agree with what pdf() and background() say.
void expectConsistentSamples(const InfiniteLight& light, std::uint64_t seed) {
  Rng rng(seed);
  int atBorder = 0;
  for (int i = 0; i < 20000; ++i) {
    const LightSample s = light.sample(kAnywhere, {rng.uniform(), rng.uniform()});
    ASSERT_GT(s.pdf, 0);
    ASSERT_NEAR(length(s.wi), 1, 3e-7f);
    const float pdf = light.pdf(kAnywhere, s.wi, nullptr);
    // The density is constant in a cell, so rounding shows only when it carries a sample over a border.
    if (std::abs(pdf - s.pdf) > 1e-4f * s.pdf) ++atBorder;
    const Rgb seen = light.background(s.wi);
    EXPECT_NEAR(seen.r, s.radiance.r, 1e-3f * light.background(s.wi).r + 1e-3f);
  }
  EXPECT_LE(atBorder, 5);
}

TEST(InfiniteLight, SamplesAgreeWithPdfAndBackground) {
  expectConsistentSamples(InfiniteLight(kTurned, {.map = gradient()}), 1);
  expectConsistentSamples(InfiniteLight(Transform::scale(-1, 1, 1) * kTurned, {.map = gradient()}), 2);
  expectConsistentSamples(InfiniteLight(Transform::scale(2, 1, 0.5), {.map = gradient()}), 3);
}

/// Integral of pdf() over the sphere by stratified uniform directions: mean of pdf · 4π is 1.
TEST(InfiniteLight, PdfIntegratesToOne) {
  const std::vector<InfiniteLight::Params> params{
      {.map = gradient()},
      {.map = sun(16, 8, 3, 0)},
      {.radiance = {0, 1, 0}, .map = gradient()},
      {.map = makePicture(5, 3, [](int x, int y) { return Rgb(static_cast<float>(x * y)); })}};
  for (const Transform& t : {Transform(), kTurned, Transform::scale(-1, 1, 1), Transform::scale(3, 1, 0.7)}) {
    for (std::size_t k = 0; k < params.size(); ++k) {
      const InfiniteLight light(t, params[k]);
      const auto pdf = [&](Rng& rng) {
        return light.pdf(kAnywhere, sampleUniformSphere({rng.uniform(), rng.uniform()}), nullptr) * 4 * kPi;
      };
      const test::ZTest z = test::runZTest(pdf, 1, 10 + k, 200000);
      EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << "map " << k << ": " << z;
    }
  }
}

/// Samples counted in cells of equal solid angle against the integral of pdf() over the cell.
test::ChiSquareTest chiSquare(const InfiniteLight& light, double pdfFactorOnUpperHalf = 1) {
  constexpr int kZ = 24, kPhi = 32, kCount = 100000, kPerSide = 16;
  std::vector<double> observed(kZ * kPhi), expected(kZ * kPhi);
  Rng rng(99);
  for (int i = 0; i < kCount; ++i) {
    const Vector3f w = light.sample(kAnywhere, {rng.uniform(), rng.uniform()}).wi;
    const int z = std::min(static_cast<int>((w.z + 1) / 2 * kZ), kZ - 1);
    const double phi = std::atan2(w.y, w.x) + (w.y < 0 ? 2 * std::numbers::pi : 0);
    const int p = std::min(static_cast<int>(phi / (2 * std::numbers::pi) * kPhi), kPhi - 1);
    ++observed[static_cast<std::size_t>(z * kPhi + p)];
  }
  double total = 0;
  for (int z = 0; z < kZ; ++z) {
    for (int p = 0; p < kPhi; ++p) {
      double sum = 0;
      for (int i = 0; i < kPerSide * kPerSide; ++i) {
        const double cosine = 2 * (z + (i / kPerSide + 0.5) / kPerSide) / kZ - 1;
        const double phi = 2 * std::numbers::pi * (p + (i % kPerSide + 0.5) / kPerSide) / kPhi;
        const double sine = std::sqrt(1 - cosine * cosine);
        sum += light.pdf(kAnywhere, Vector3f(Vec3d{sine * std::cos(phi), sine * std::sin(phi), cosine}),
                         nullptr);
      }
      double& e = expected[static_cast<std::size_t>(z * kPhi + p)];
      e = kCount * sum / (kPerSide * kPerSide) * 4 * std::numbers::pi / (kZ * kPhi);
      if (z >= kZ / 2) e *= pdfFactorOnUpperHalf;
      total += e;
    }
  }
  for (double& e : expected) e *= kCount / total;
  return test::chiSquareTest(observed, expected);
}

TEST(InfiniteLight, SamplesAreDistributedByThePdf) {
  for (const Transform& t : {Transform(), Transform::scale(-1, 1, 1)}) {
    const test::ChiSquareTest c = chiSquare(InfiniteLight(t, {.map = gradient()}));
    EXPECT_GT(c.pValue(), test::sidak(kMinPValue, 4)) << c;
    EXPECT_GT(c.degreesOfFreedom, 500u);
  }
  // Turned and stretched, cell borders are curves and the midpoint rule meets them: still within the noise.
  for (const Transform& t : {kTurned, Transform::scale(1.3, 1, 0.8)}) {
    const test::ChiSquareTest c = chiSquare(InfiniteLight(t, {.map = gradient()}));
    EXPECT_GT(c.pValue(), test::sidak(kMinPValue, 4)) << c;
  }
}

TEST(InfiniteLight, ChiSquareSeesAPdfThatIsAFifthOff) {
  const test::ChiSquareTest c = chiSquare(InfiniteLight(Transform(), {.map = gradient()}), 1.2);
  EXPECT_LT(c.pValue(), kMinPValue) << c;
}

TEST(InfiniteLight, CanSampleEveryDirectionThatIsNotBlack) {
  // A sun beside a pole, at the seam, and in a map that is resampled: interpolation bleeds into neighbours.
  const std::vector<Image> maps{sun(16, 8, 5, 0), sun(16, 8, 0, 4), sun(16, 8, 15, 7), sun(10, 5, 4, 2)};
  for (const Image& map : maps) {
    const InfiniteLight light(kTurned, {.map = map});
    Rng rng(5);
    int lit = 0, impossible = 0;
    for (int i = 0; i < 200000; ++i) {
      const Vector3f w = sampleUniformSphere({rng.uniform(), rng.uniform()});
      if (light.background(w).r <= 0) continue;
      ++lit;
      impossible += light.pdf(kAnywhere, w, nullptr) <= 0;
    }
    EXPECT_GT(lit, 100);
    EXPECT_EQ(impossible, 0);
  }
}

TEST(InfiniteLight, IrradianceByLightSamplesEqualsThatByDirections) {
  const std::vector<InfiniteLight::Params> params{{},
                                                  {.map = gradient()},
                                                  {.map = sun(16, 8, 3, 1)},
                                                  {.map = sun(16, 8, 3, 7)},
                                                  {.map = makePicture(13, 6, [](int x, int y) {
                                                     return Rgb(static_cast<float>((x * 7 + y * 5) % 11));
                                                   })}};
  const Normal3f n = normalize(Vector3f{0.2f, 0.9f, -0.1f});
  for (std::size_t k = 0; k < params.size(); ++k) {
    for (const Transform& t : {kTurned, Transform::scale(1, -1, 1), Transform::scale(1.5, 1, 0.6)}) {
      const InfiniteLight light(t, params[k]);
      const test::ZTest z = zTest(test::irradianceByLight(light, kAnywhere, n, 20 + k, 50000),
                                  test::irradianceByDirection(light, n, 40 + k, 400000));
      EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << "map " << k << ": " << z;
    }
  }
}

TEST(InfiniteLight, IrradianceOfAConstantIsPiTimesIt) {
  const Normal3f n{0, 0.6f, 0.8f};
  const InfiniteLight plain(Transform(), {.radiance = Rgb(2)});
  const InfiniteLight mapped(kTurned,
                             {.radiance = Rgb(2), .map = makePicture(3, 5, [](int, int) { return Rgb(1); })});
  for (const InfiniteLight* light : {&plain, &mapped}) {
    const test::ZTest z =
        zTest(test::irradianceByLight(*light, kAnywhere, n, 8, 200000), 2 * std::numbers::pi);
    EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
  }
}

TEST(InfiniteLight, ImportanceSamplingOfASunBeatsUniformDirectionsAHundredfold) {
  const InfiniteLight light(Transform(), {.map = sun(64, 32, 20, 10)});
  const Normal3f n{0, 0, 1};
  const double byLight = test::irradianceByLight(light, kAnywhere, n, 8, 20000).variance();
  const double byDirection = test::irradianceByDirection(light, n, 8, 200000).variance();
  EXPECT_GT(byDirection, 100 * byLight);
}

TEST(InfiniteLight, PdfIsConstantAndFiniteInThePolarCells) {
  const InfiniteLight light(Transform(), {.map = gradient()});
  const float atPole = light.pdf(kAnywhere, {1e-6f, 1e-7f, 1}, nullptr);
  EXPECT_GT(atPole, 0);
  EXPECT_TRUE(std::isfinite(light.pdf(kAnywhere, {0, 0, 1}, nullptr)));
  EXPECT_TRUE(std::isfinite(light.pdf(kAnywhere, {0, 0, -1}, nullptr)));
  EXPECT_FLOAT_EQ(light.pdf(kAnywhere, direction(0.01, 0.2), nullptr), atPole);
}

TEST(InfiniteLight, SpreadsNegativeTexelsToo) {
  // What is stored is what is shown; the density is that of the magnitude, so nothing is lost.
  const InfiniteLight light(
      Transform(), {.map = makePicture(4, 4, [](int x, int) { return Rgb(x == 1 ? -2.0f : 0.0f); })});
  const Vector3f w = direction(1.5 / 4, 0.5);
  EXPECT_NEAR(light.background(w).r, -2, 1e-4f);
  EXPECT_GT(light.pdf(kAnywhere, w, nullptr), 0);
}

TEST(InfiniteLight, PowerIsTheMeanRadianceThroughTheSceneSphere) {
  InfiniteLight light(Transform(), {.radiance = {1, 2, 3}, .map = gradient()});
  light.preprocess({{-1, -2, -2}, {1, 2, 2}});  // radius 3
  expectRgb(light.power(), 9 * kPi * Rgb{1 * 4.5f, 2 * 5.5f, 3 * 0.5f});
  InfiniteLight plain(Transform(), {.radiance = {1, 2, 3}});
  plain.preprocess({{-1, -2, -2}, {1, 2, 2}});
  expectRgb(plain.power(), 9 * kPi * Rgb{1, 2, 3});
}

TEST(InfiniteLight, RefusesSingularTransformsAndBadMaps) {
  EXPECT_THROW(InfiniteLight(Transform::scale(1, 0, 1), {}), std::invalid_argument);
  EXPECT_THROW(InfiniteLight(Transform(), {.map = Image()}), std::invalid_argument);
  EXPECT_THROW(
      InfiniteLight(Transform(), {.map = makePicture(2, 2, [](int, int) { return Rgb(kInfinity); })}),
      std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
