// SPDX-License-Identifier: BSD-2-Clause
// Media that emit under any law g: light comes from where flights collide, so a ray gains the integral of
// sigma_a Le (-g'(F)) dt, found by distance and by light samples.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "freeflight/flight_list.h"
#include "media/grid_medium.h"
#include "support/scene_kit.h"
#include "transmittance/estimator_list.h"
#include "world/medium_light.h"

namespace pbrtmedia {
namespace {

using namespace test;

struct Gas {
  Rgb sigmaA, sigmaS, le;
};

/// Flights that serve the law whatever the density.
AnyFlight flightsOf(const AnyLaw& law) {
  if (std::holds_alternative<LinearLaw>(law)) return RegularFlight{};
  return WeightedDeltaTracking{};
}

AnyEstimator under(AnyEstimator estimator, const AnyLaw& law) {
  EXPECT_TRUE(setLaw(estimator, law)) << nameOf(estimator) << " and " << nameOf(law);
  return estimator;
}

/// Density 1 on [-half, half]^3.
GridMediumParams gridOf(const Gas& gas, const AnyEstimator& estimator, float half = 3) {
  GridMediumParams p;
  p.name = "gas";
  p.sigmaA = gas.sigmaA;
  p.sigmaS = gas.sigmaS;
  p.le = gas.le;
  p.estimator = estimator;
  p.flights = flightsOf(lawOf(estimator));
  p.grid.nx = p.grid.ny = p.grid.nz = 5;
  p.grid.density.assign(125, 1.0f);
  p.grid.border = GridBorder::Clamp;
  p.grid.p0 = {-half, -half, -half};
  p.grid.p1 = {half, half, half};
  return p;
}
const Medium* make(SceneKit& kit, const GridMediumParams& p) {
  return kit.builder.own(makeGridMedium(p, Transform()));
}

std::vector<AnyLaw> manyLaws() {
  return {PinkNoiseLaw{1.2}, DavisLaw{.8, .5},      DavisLaw{3, .3},
          DavisLaw{1, 0},    MixtureLaw{.3, .1, 2}, LinearLaw{1.7}};
}

/// Along z from above, into a slab from z = thickness down to 0.
const Ray kDown = rayOf({0.1f, 0.2f, 5}, {0, 0, -1});
Estimates throughSlab(const GridMediumParams& gas, float thickness, std::uint64_t n) {
  SceneKit kit;
  const Medium* medium = make(kit, gas);
  kit.builder.addPrimitive({.shape = kit.box({-2, -2, 0}, {2, 2, thickness}), .media = {medium, nullptr}});
  const auto scene = kit.finish();
  return estimate(*makeVolPath(*scene, {.maxDepth = 0}), kDown, n);
}

TEST(EmissionUnderLaws, SlabEmitsWhatItAbsorbs) {
  for (const AnyLaw& law : manyLaws()) {
    for (const std::string_view name : estimatorNames()) {
      const AnyEstimator plain = *findEstimator(name);
      if (!traitsOf(plain).laws.has(law)) continue;
      for (const float thickness : {0.02f, 1.0f, 2.5f}) {
        // Thin, and of so many mean free paths that flights look for the light; part of it scatters.
        const Gas gas{Rgb(0.3f, 2, 9), Rgb(0.2f, 0, 1), Rgb(1, 5, 0.2f)};
        const Estimates e = throughSlab(gridOf(gas, under(plain, law)), thickness, 1 << 12);
        const RunningStats* channels[] = {&e.red, &e.green, &e.blue};
        for (std::size_t c = 0; c < 3; ++c) {
          const double sigma = double{gas.sigmaA[c]} + double{gas.sigmaS[c]};
          const double truth = double{gas.le[c]} * double{gas.sigmaA[c]} / sigma *
                               (1 - transmittanceOf(law, sigma * double{thickness}));
          EXPECT_LT(std::abs(channels[c]->mean() - truth),
                    kMaxAbsZ * channels[c]->standardError() + 1e-6 * truth)
              << nameOf(law) << ", " << name << ", thickness " << thickness << ", channel " << c << ": "
              << zTest(*channels[c], truth);
        }
        EXPECT_EQ(e.counters.droppedTotal(), 0u);
      }
    }
  }
}

TEST(EmissionUnderLaws, TheSlabIsNotDimmedByWhatGetsThrough) {
  // Negative control: the integral of sigma Le g(F), under which a furnace would not be white, and that of
  // the exponential law.
  const DavisLaw law{2, .5};
  const Estimates e = throughSlab(gridOf({Rgb(2), Rgb(0), Rgb(3)}, RegularTracking{law}), 2, 1 << 16);
  double dimmed = 0;
  for (int i = 0; i < 4000; ++i) dimmed += 3 * law((i + .5) * 4 / 4000) * 4 / 4000;
  EXPECT_LT(std::abs(zTest(e.red, 3 * (1 - law(4))).z()), kMaxAbsZ);
  EXPECT_GT(std::abs(zTest(e.red, dimmed).z()), kMaxAbsZ);
  EXPECT_GT(std::abs(zTest(e.red, 3 * -std::expm1(-4.0)).z()), kMaxAbsZ);
  EXPECT_GT(std::abs(zTest(e.red, 3 * (1 - law(4)) * 1.02).z()), kMaxAbsZ) << "two percent are seen";
}

TEST(EmissionUnderLaws, LayersHideWhatIsBehindThem) {
  // Two densities along the ray: the exact integral layer by layer, for a profile that meets both.
  const DavisLaw law{1.5, .6};
  GridMediumParams p = gridOf({Rgb(1), Rgb(0), Rgb(2)}, DebiasedRayMarching{.law = law});
  p.grid.nx = p.grid.ny = 1;
  p.grid.nz = 2;
  p.grid.density = {6, .5f};
  p.grid.p0 = {-2, -2, 0};
  p.grid.p1 = {2, 2, 1};
  // Trilinear between the samples at 1/4 and 3/4: all of it, as the source is the same everywhere.
  const Estimates e = throughSlab(p, 1, 1 << 14);
  const double depth = 6 * .25 + .5 * .25 + (6 + .5) / 2 * .5;
  const ZTest test = zTest(e.red, 2 * (1 - law(depth)));
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_LT(test.standardError, 0.02);
}

TEST(EmissionUnderLaws, HotFurnaceIsWhite) {
  for (const AnyLaw& law : manyLaws()) {
    for (const float sigmaS : {0.0f, 1.5f}) {
      SceneKit kit;
      const Medium* medium = make(kit, gridOf({Rgb(0.7f), Rgb(sigmaS), Rgb(1)}, RegularTracking{law}));
      kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1.5f), .media = {medium, nullptr}});
      kit.builder.addPrimitive({.shape = kit.sphere({0.3f, 0, 0}, 0.4f), .material = kit.matte(1)});
      kit.sky(1);
      const auto scene = kit.finish();
      const ZTest test = zTest(
          estimate(*makeVolPath(*scene, {.maxDepth = 100000}), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 1 << 12)
              .red,
          1);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(law) << ' ' << sigmaS << ": " << test;
      EXPECT_LT(test.standardError, 0.03) << nameOf(law);
    }
  }
}

/// Always picks the first light, a dark one: emission is found by distances alone.
class PicksTheDark final : public LightSelector {
 public:
  Choice choose(const LightReceiver&, float) const override { return {0, 1}; }
  float probability(const LightReceiver&, std::size_t light) const override {
    return light == 0 ? 1.0f : 0.0f;
  }
};

/// What `ray` finds in a scene with and without light samples of the media.
struct TwoWays {
  Estimates lit, unlit;
};
template <class Build>
TwoWays twoWays(const Build& build, const Ray& ray, const PathParams& params, std::uint64_t n) {
  SceneKit bright, dark;
  build(bright);
  build(dark);
  dark.pointLight({9, 9, 9}, 0);
  const auto lit = bright.finish(), unlit = dark.finish();
  EXPECT_GE(lit->illuminants().size(), 1u);
  const VolPathIntegrator integrator(*unlit, params, std::make_unique<PicksTheDark>(),
                                     CameraMedium(*unlit, kFarAway, 0, nullptr));
  return {estimate(*makeVolPath(*lit, params), ray, n), estimate(integrator, ray, n, 2)};
}

TEST(EmissionUnderLaws, FloorUnderAGlowingBallEqualsQuadrature) {
  for (const AnyLaw& law : manyLaws()) {
    const auto build = [&](SceneKit& kit) {
      const Medium* gas = make(kit, gridOf({Rgb(1.3f), Rgb(0), Rgb(3)}, RegularTracking{law}, 1.2f));
      kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {gas, nullptr}});
      kit.builder.addPrimitive({.shape = kit.square(-2, 10), .material = kit.matte(0.5f)});
    };
    const TwoWays found = twoWays(build, rayOf({2, 0, -1}, {-2, 0, -1}), {.maxDepth = 1}, 1 << 15);
    double truth = 0;
    constexpr int kSteps = 20000;
    const double edge = std::asin(.5);
    for (int i = 0; i < kSteps; ++i) {
      const double a = (i + 0.5) * edge / kSteps, s = std::sin(a);
      const double chord = 2 * std::sqrt(std::max(0.0, 1 - 4 * s * s));
      truth += std::cos(a) * s * 3 * (1 - transmittanceOf(law, double{1.3f} * chord)) * edge / kSteps;
    }
    const ZTest with = zTest(found.lit.red, truth), without = zTest(found.unlit.red, truth);
    EXPECT_LT(std::abs(with.z()), kMaxAbsZ) << nameOf(law) << ": " << with;
    EXPECT_LT(std::abs(without.z()), kMaxAbsZ) << nameOf(law) << ": " << without;
    EXPECT_LT(with.standardError, 0.8 * without.standardError) << "light samples help";
    EXPECT_GT(std::abs(zTest(found.lit.red, 1.06 * truth).z()), kMaxAbsZ) << "six percent are seen";
  }
}

TEST(EmissionUnderLaws, LightSamplesSeeGasInOtherMediaAsPathsDo) {
  // The gas fills a part of what its boundary surrounds, and the fog has a law of its own: what it lets
  // through in front of the gas and inside of it must not be multiplied.
  const AnyLaw fogLaw = DavisLaw{2, .5};
  for (const AnyLaw& gasLaw : {AnyLaw(ExponentialLaw{}), AnyLaw(PinkNoiseLaw{1})}) {
    const auto build = [&](SceneKit& kit) {
      GridMediumParams gas = gridOf({Rgb(1.5f), Rgb(0.5f), Rgb(3)}, RegularTracking{gasLaw}, 0.8f);
      GridMediumParams fog = gridOf({Rgb(0.6f), Rgb(0.6f), Rgb(0)}, RegularTracking{fogLaw}, 3);
      fog.name = "fog";
      gas.overlap.mode = fog.overlap.mode = OverlapRule::Mode::Add;
      kit.builder.addPrimitive(
          {.shape = kit.box({-2, -2, -1.9f}, {2, 2, 2}), .media = {make(kit, gas), nullptr}});
      kit.builder.addPrimitive(
          {.shape = kit.box({-2.5f, -2.5f, -1.95f}, {2.5f, 2.5f, 2.5f}), .media = {make(kit, fog), nullptr}});
      kit.builder.addPrimitive({.shape = kit.square(-2, 10), .material = kit.matte(0.5f)});
    };
    const Ray belowTheFog = rayOf({4, 0, -1.97f}, {-4, 0, -0.03f});
    for (const int depth : {1, 3}) {
      const TwoWays found = twoWays(build, belowTheFog, {.maxDepth = depth}, 1 << 16);
      const ZTest same = zTest(found.lit.red, found.unlit.red);
      EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << nameOf(gasLaw) << ", depth " << depth << ": " << same;
      EXPECT_LT(found.lit.red.standardError(), 0.03 * found.lit.red.mean());
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
