// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "fields/analytic_density.h"
#include "fields/gradient_noise.h"
#include "fields/perlin_density.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20241124;

struct Case {
  std::string name;
  std::shared_ptr<const DensityFunction> function;
  Bounds3d domain;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const Bounds3d unit{{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}};
  for (const std::string_view name : analyticNames()) {
    const AnyAnalytic density = *findAnalytic(name);
    const bool isLarge = std::holds_alternative<SineSphere>(density);
    all.push_back({std::string(name), makeAnalyticDensity(density),
                   isLarge ? Bounds3d{{-11, -11, -1}, {11, 11, 21}} : unit});
  }
  all.push_back(
      {"soft ball", makeAnalyticDensity(Ball{.center = {.2f, 0, -.1f}, .radius = .9, .edge = .4}), unit});
  all.push_back({"narrow needle", makeAnalyticDensity(Needle{.floor = 0, .width = 1e-4}), unit});
  for (const int octaves : {1, 4, 12}) {
    for (const double threshold : {0., .5, .6}) {
      PerlinDensity::Params params;
      params.octaves = octaves;
      params.threshold = threshold;
      params.frequency = 1.7;
      params.seed = 5;
      all.push_back({"Perlin", std::make_shared<PerlinDensity>(params), {{-20, 3, 1e4}, {20, 30, 1e4 + 40}}});
    }
  }
  return all;
}

Vec3d pointIn(const Bounds3d& box, Rng& rng) {
  // Every fourth coordinate lies on a face.
  const auto pick = [&](double lo, double hi) {
    const double u = rng.uniformDouble();
    return rng.uniformInt(4) == 0 ? (u < .5 ? lo : hi) : std::min(lo + u * (hi - lo), hi);
  };
  return {pick(box.min.x, box.max.x), pick(box.min.y, box.max.y), pick(box.min.z, box.max.z)};
}

TEST(DensityFunctions, StayWithinTheRangesTheyClaim) {
  Rng rng(kSeed);
  for (const Case& c : cases()) {
    for (const double size : {3., .5, .05, 1e-3}) {
      for (int n = 0; n < 40; ++n) {
        const Vec3d corner = pointIn(c.domain, rng);
        const Bounds3d box{
            corner, corner + Vec3d(rng.uniformDouble(), rng.uniformDouble(), rng.uniformDouble()) * size};
        const std::optional<Interval> range = c.function->range(box);
        ASSERT_TRUE(range) << c.name;
        ASSERT_GE(range->lo, 0) << c.name;
        for (int i = 0; i < 100; ++i) {
          const Vec3d p = pointIn(box, rng);
          const double d = double{c.function->at(p)};
          ASSERT_LE(d, range->hi * (1 + 1e-7)) << c.name << " size " << size;
          ASSERT_GE(d, range->lo * (1 - 1e-7)) << c.name << " size " << size;
        }
      }
    }
  }
}

TEST(DensityFunctions, HaveRangesThatTightenWithTheBox) {
  Rng rng(kSeed);
  for (const Case& c : cases()) {
    if (c.name == "sphere" || c.name == "slab" || c.name == "sinesphere") continue;  // these jump
    for (int n = 0; n < 50; ++n) {
      const Vec3d p = pointIn(c.domain, rng);
      const auto range = c.function->range({p, p + Vec3d(1e-9, 1e-9, 1e-9)});
      EXPECT_LT(range->width(), 1e-3 * (1 + range->hi)) << c.name;
    }
  }
}

TEST(GradientNoise, VanishesAtLatticePointsAndIsSmooth) {
  const GradientNoise noise(3);
  Rng rng(kSeed);
  for (int n = 0; n < 200; ++n) {
    const Vec3d lattice(std::floor(100 * rng.uniformDouble()) - 50, std::floor(100 * rng.uniformDouble()),
                        std::floor(1e6 * rng.uniformDouble()));
    EXPECT_EQ(noise.at(lattice), 0.0);
    // Across a face of the lattice value and slope go on.
    const Vec3d face(lattice.x, lattice.y + rng.uniformDouble(), lattice.z + rng.uniformDouble());
    const auto slope = [&](double from) {
      return (noise.at(face + Vec3d(from + 1e-6, 0, 0)) - noise.at(face + Vec3d(from, 0, 0))) / 1e-6;
    };
    EXPECT_NEAR(slope(-1e-6), slope(0), 1e-4);
  }
}

TEST(GradientNoise, HasMeanZeroAndDependsOnItsSeed) {
  double sum = 0, squares = 0, product = 0;
  Rng rng(kSeed);
  constexpr int kN = 200000;
  for (int n = 0; n < kN; ++n) {
    const Vec3d p = Vec3d(rng.uniformDouble(), rng.uniformDouble(), rng.uniformDouble()) * 1e4;
    const double a = GradientNoise(1).at(p), b = GradientNoise(2).at(p);
    sum += a;
    squares += a * a;
    product += a * b;
  }
  const double variance = squares / kN;
  EXPECT_LT(std::abs(sum / kN), 5 * std::sqrt(variance / kN));
  EXPECT_LT(std::abs(product / kN), 5 * variance / std::sqrt(kN));
  EXPECT_GT(variance, .02);
}

TEST(PerlinDensity, LeavingOctavesOutChangesNoValue) {
  // Against the plain sum of all octaves, which the range over a point is. Of few octaves the last often
  // decides.
  PerlinDensity::Params many, few;
  many.octaves = 12;
  few.octaves = 2;
  few.gain = 1;
  many.threshold = few.threshold = .55;
  for (const PerlinDensity::Params& params : {many, few}) {
    Rng rng(kSeed);
    const PerlinDensity density(params);
    constexpr int kPoints = 50000;
    int empty = 0;
    for (int n = 0; n < kPoints; ++n) {
      const Vec3d p = Vec3d(rng.uniformDouble(), rng.uniformDouble(), rng.uniformDouble()) * 30;
      const auto range = density.range({p, p});
      ASSERT_NEAR(double{density.at(p)}, (range->lo + range->hi) / 2, 1e-6)
          << params.octaves << " octaves at " << p;
      empty += density.at(p) == 0;
    }
    EXPECT_GT(empty, kPoints / 5);
    EXPECT_LT(empty, kPoints - kPoints / 50);
  }
}

TEST(AnalyticDensity, TheSineSphereHasThePublishedIntegrals) {
  const auto density = makeAnalyticDensity(SineSphere{});
  double tau = 0, squares = 0, largest = 0;
  constexpr int kN = 200000;
  for (int i = 0; i < kN; ++i) {
    const double d = double{density->at({0, 0, 20 * (i + .5) / kN})};
    tau += d * 20 / kN;
    squares += d * d * 20 / kN;
    largest = std::max(largest, d);
  }
  EXPECT_NEAR(tau, 3.415684, 1e-5);
  EXPECT_NEAR(squares, 1.960753, 1e-5);
  EXPECT_NEAR(largest, .95598, 1e-5);
}

TEST(AnalyticDensity, TheNeedleTransmitsWhatItsClosedFormSays) {
  const auto density = makeAnalyticDensity(Needle{});
  double tau = 0;
  constexpr int kN = 1000000;
  for (int i = 0; i < kN; ++i) tau += double{density->at({0, 0, (i + .5) / kN})} / kN;
  EXPECT_NEAR(std::exp(-tau), 0.0060165, 1e-6);
}

TEST(AnalyticDensity, TheEdgeOfABallIsASmoothStep) {
  const auto density = makeAnalyticDensity(Ball{.center = {1, 0, 0}, .radius = 2, .edge = 1});
  // t^2 (3 - 2 t) at t = 1/4, 1/2 and 3/4 of the way from the surface to the inner end of the edge.
  EXPECT_FLOAT_EQ(density->at({2.75, 0, 0}), 5.f / 32);
  EXPECT_FLOAT_EQ(density->at({1, 1.5, 0}), .5f);
  EXPECT_FLOAT_EQ(density->at({1, 0, -1.25}), 27.f / 32);
  EXPECT_EQ(density->at({1, 0, 1}), 1);
  EXPECT_EQ(density->at({1, 2.001, 0}), 0);
}

TEST(DensityFunctions, RefuseParametersOutOfRange) {
  EXPECT_THROW(makeAnalyticDensity(Ball{.radius = 0}), SceneError);
  EXPECT_THROW(makeAnalyticDensity(Ball{.radius = 1, .edge = 2}), SceneError);
  EXPECT_THROW(makeAnalyticDensity(Slab{.from = 1, .to = 1}), SceneError);
  EXPECT_THROW(makeAnalyticDensity(Ramp{.from = 1, .to = 0}), SceneError);
  EXPECT_THROW(makeAnalyticDensity(Needle{.floor = -1}), SceneError);
  EXPECT_THROW(makeAnalyticDensity(Needle{.width = 0}), SceneError);
  for (const auto& params : {PerlinDensity::Params{.octaves = 0}, PerlinDensity::Params{.octaves = 33},
                             PerlinDensity::Params{.lacunarity = .5}, PerlinDensity::Params{.gain = 0},
                             PerlinDensity::Params{.frequency = 0}, PerlinDensity::Params{.threshold = 1}}) {
    EXPECT_THROW(PerlinDensity{params}, SceneError);
  }
  EXPECT_FALSE(findAnalytic("spere"));
}

}  // namespace
}  // namespace pbrtmedia
