// SPDX-License-Identifier: BSD-2-Clause
// Photons in media of any law g of the optical depth F bring what paths from a camera find there: light that
// comes from outside is dimmed by g(F) wherever it is, in the medium and behind it, and light that comes from
// a collision of the medium by -g'(F).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "freeflight/flight_list.h"
#include "lights/distant.h"
#include "media/grid_medium.h"
#include "support/direct_photons.h"
#include "support/function_line.h"
#include "support/running_stats.h"
#include "support/z_test.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr int kSeeds = 16, kPaths = 2000;

std::vector<AnyLaw> manyLaws() {
  return {PinkNoiseLaw{1.2},     DavisLaw{.8, .5},     DavisLaw{3, .3}, DavisLaw{1, 0},
          MixtureLaw{.3, .1, 2}, MixtureLaw{.4, 0, 3}, LinearLaw{1.7},  ExponentialLaw{}};
}

struct Gas {
  Rgb sigmaA, sigmaS, le;
};

/// Density 1 in a cube around the origin.
const Medium* gridOf(SceneKit& kit, const Gas& gas, const AnyLaw& law, float half) {
  GridMediumParams p;
  p.name = "gas";
  p.sigmaA = gas.sigmaA;
  p.sigmaS = gas.sigmaS;
  p.le = gas.le;
  AnyEstimator estimator = RegularTracking{};
  EXPECT_TRUE(setLaw(estimator, law));
  p.estimator = estimator;
  p.flights = RegularFlight{};
  p.grid.nx = p.grid.ny = p.grid.nz = 3;
  p.grid.density.assign(27, 1.0f);
  p.grid.border = GridBorder::Clamp;
  p.grid.p0 = {-half, -half, -half};
  p.grid.p1 = {half, half, half};
  return kit.builder.own(makeGridMedium(p, Transform()));
}

/// A beam down into a slab, and a black floor below: photons that scatter in each quarter of the slab, and
/// those on the floor, per area.
struct SlabUnderBeam {
  static constexpr int kQuarters = 4;
  static constexpr double kThickness = 2, kIrradiance = 2, kHalf = 1;  ///< of the square that is looked at
  const Gas gas{Rgb(.3f, .1f, 2), Rgb(.4f, 1.6f, 2), Rgb(0)};
  std::array<std::array<RunningStats, 3>, kQuarters> scattered;
  std::array<RunningStats, 3> passed;

  explicit SlabUnderBeam(const AnyLaw& law) {
    SceneKit kit;
    const Medium* const medium = gridOf(kit, gas, law, 3);
    kit.builder.addPrimitive({.shape = kit.box({-2, -2, 0}, {2, 2, kThickness}), .media = {medium, nullptr}});
    kit.builder.addPrimitive({.shape = kit.square(-.5f, 2), .material = kit.matte(.5f)});
    kit.builder.addLight(std::make_unique<DistantLight>(
        Transform(), DistantLight::Params{.radiance = Rgb(kIrradiance), .from = {0, 0, 1}, .to = {0, 0, 0}}));
    const auto scene = kit.finish();
    DirectPhotons photons(*scene);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) add(photons.trace(seed, kPaths));
  }
  double sigmaT(std::size_t c) const { return double{gas.sigmaA[c]} + double{gas.sigmaS[c]}; }

 private:
  static bool isLookedAt(Point3f p) { return std::max(std::abs(p.x), std::abs(p.y)) <= kHalf; }
  void add(const PhotonMaps& maps) {
    constexpr float kAll = 10;
    std::array<std::array<double, 3>, kQuarters> here{};
    std::array<double, 3> below{};
    const double scale = 1 / (maps.paths * 4 * kHalf * kHalf);
    maps.inMedia.within({0, 0, 0}, kAll, [&](const MediumPhoton& p, float) {
      if (!isLookedAt(p.p)) return;
      const auto quarter =
          std::min(kQuarters - 1, static_cast<int>((kThickness - double{p.p.z}) / kThickness * kQuarters));
      for (std::size_t c = 0; c < 3; ++c)
        here[static_cast<std::size_t>(quarter)][c] += scale * double{p.power[c]};
    });
    maps.onSurfaces.within({0, 0, 0}, kAll, [&](const SurfacePhoton& p, float) {
      if (!isLookedAt(p.p)) return;
      for (std::size_t c = 0; c < 3; ++c) below[c] += scale * double{p.power[c]};
    });
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t q = 0; q < kQuarters; ++q) scattered[q][c].add(here[q][c]);
      passed[c].add(below[c]);
    }
  }
};

TEST(PhotonsUnderLaws, OfABeamAreAsDenseAsItsTransmittance) {
  for (const AnyLaw& law : manyLaws()) {
    const SlabUnderBeam found(law);
    double farFromFlights = 0;  // largest z of what flights by the law would bring
    for (std::size_t c = 0; c < 3; ++c) {
      const double sigmaT = found.sigmaT(c), sigmaS{found.gas.sigmaS[c]};
      for (std::size_t q = 0; q < SlabUnderBeam::kQuarters; ++q) {
        const double from = SlabUnderBeam::kThickness * static_cast<double>(q) / SlabUnderBeam::kQuarters,
                     to = SlabUnderBeam::kThickness * static_cast<double>(q + 1) / SlabUnderBeam::kQuarters;
        const double through =
            simpson([&](double s) { return transmittanceOf(law, sigmaT * s); }, from, to, 4000);
        const ZTest test = zTest(found.scattered[q][c], SlabUnderBeam::kIrradiance * sigmaS * through);
        EXPECT_LT(std::abs(test.z()), kMaxAbsZ)
            << nameOf(law) << ", channel " << c << ", quarter " << q << ": " << test;
        EXPECT_LT(test.standardError, .1 * SlabUnderBeam::kIrradiance * sigmaS / 4) << nameOf(law);
        const double flown =
            (transmittanceOf(law, sigmaT * from) - transmittanceOf(law, sigmaT * to)) / sigmaT;
        farFromFlights =
            std::max(farFromFlights,
                     std::abs(zTest(found.scattered[q][c], SlabUnderBeam::kIrradiance * sigmaS * flown).z()));
      }
      const ZTest passed =
          zTest(found.passed[c],
                SlabUnderBeam::kIrradiance * transmittanceOf(law, sigmaT * SlabUnderBeam::kThickness));
      EXPECT_LT(std::abs(passed.z()), kMaxAbsZ) << nameOf(law) << ", channel " << c << ": " << passed;
    }
    if (!std::holds_alternative<ExponentialLaw>(law)) {
      EXPECT_GT(farFromFlights, kMaxAbsZ) << nameOf(law) << ": flights collide elsewhere";
    }
  }
}

/// A ball that emits, in the middle of a dark hollow: all that leaves the ball is found there.
TEST(PhotonsUnderLaws, OfAGlowingBallCarryWhatItRadiates) {
  constexpr double kRadius = 1, kSigma = 2.5, kLe = 3;
  for (const AnyLaw& law : manyLaws()) {
    SceneKit kit;
    const Medium* const medium = gridOf(kit, {Rgb(kSigma), Rgb(0), Rgb(kLe)}, law, 1.01f);
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, kRadius), .media = {medium, nullptr}});
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 4), .material = kit.matte(.5f)});
    const auto scene = kit.finish();
    scene->prepareEmission();
    DirectPhotons photons(*scene);
    RunningStats power;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const PhotonMaps maps = photons.trace(seed, 4 * kPaths);
      double sum = 0;
      maps.onSurfaces.within({0, 0, 0}, 5, [&](const SurfacePhoton& p, float) { sum += double{p.power.g}; });
      power.add(sum / maps.paths);
    }
    // Radiance along a chord of 2 R mu, over directions and the surface.
    const auto radiated = [&](const auto& seen) {
      const double perArea =
          2 * std::numbers::pi *
          simpson([&](double mu) { return mu * kLe * seen(2 * kRadius * kSigma * mu); }, 0, 1, 1000);
      return perArea * 4 * std::numbers::pi * kRadius * kRadius;
    };
    const ZTest test = zTest(power, radiated([&](double f) { return 1 - transmittanceOf(law, f); }));
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(law) << ": " << test;
    EXPECT_TRUE(test.sees(.05)) << nameOf(law) << ": " << test;
    if (std::holds_alternative<ExponentialLaw>(law)) continue;
    // Negative control: dimmed by g(F), as light from outside is.
    const ZTest dimmed =
        zTest(power, radiated([&](double depth) {
                return simpson([&](double f) { return transmittanceOf(law, f); }, 0, depth, 100);
              }));
    EXPECT_GT(std::abs(dimmed.z()), kMaxAbsZ) << nameOf(law) << ": " << dimmed;
  }
}

}  // namespace
}  // namespace pbrtmedia
