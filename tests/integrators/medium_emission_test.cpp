// SPDX-License-Identifier: BSD-2-Clause
// Media that emit, against closed forms: found by distance and, where they are lights, by light samples.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "media/emission/emission_patterns.h"
#include "media/grid_medium.h"
#include "spectrum/spectrum.h"
#include "support/scene_kit.h"
#include "world/medium_light.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// Coefficients, and how they are stored.
struct Gas {
  Rgb sigmaA, sigmaS, le;
  enum class Storage { Homogeneous, Grid } storage = Storage::Homogeneous;
};
constexpr std::array kStorages = {Gas::Storage::Homogeneous, Gas::Storage::Grid};

/// A grid reaches over [-3, 3]^3 of `place`, beyond every boundary of these tests.
const Medium* make(SceneKit& kit, const Gas& gas, const std::string& name = "gas", OverlapRule overlap = {},
                   const Transform& place = {}) {
  GridMediumParams p;
  p.name = name;
  p.sigmaA = gas.sigmaA;
  p.sigmaS = gas.sigmaS;
  p.le = gas.le;
  p.overlap = overlap;
  if (gas.storage == Gas::Storage::Homogeneous) {
    return kit.builder.own(std::make_unique<HomogeneousMedium>(p));
  }
  p.grid.nx = p.grid.ny = p.grid.nz = 5;
  p.grid.density.assign(125, 1.0f);
  p.grid.border = GridBorder::Clamp;
  p.grid.p0 = {-3, -3, -3};
  p.grid.p1 = {3, 3, 3};
  return kit.builder.own(makeGridMedium(p, place));
}

constexpr float kTime = 0.5f;  ///< of all rays

/// How an object stands in the world.
struct Placing {
  const char* name;
  AnimatedTransform worldFromObject;
  Transform mediaFromObject;
};
const Transform kSkew = Transform::translate({1, -2, 3}) * Transform::rotate(40, {1, 2, 3}) *
                        Transform::scale(2, 0.5, 3) * Transform::rotate(70, {3, 1, 0});
std::vector<Placing> placings() {
  const auto turned = [](double degrees) {
    return Transform::translate({degrees / 50, 0, 0}) * Transform::rotate(degrees, {1, 1, 0}) *
           Transform::scale(1 + degrees / 90, 2, 0.5);
  };
  return {{"translated", AnimatedTransform(Transform::translate({3, 1, -2})), {}},
          {"rotated", AnimatedTransform(Transform::rotate(130, {2, -1, 1})), {}},
          {"skewed", AnimatedTransform(kSkew), {}},
          {"mirrored", AnimatedTransform(Transform::scale(-0.5, 2, 1)), {}},
          {"moving", AnimatedTransform(turned(0), 0, turned(80), 1), {}},
          {"a moving shape", AnimatedTransform(turned(0), 0, turned(80), 1), kSkew}};
}

Ray rayAtTime(Point3f o, Vector3f d) {
  Ray ray = rayOf(o, d);
  ray.time = kTime;
  return ray;
}
const Ray kDown = rayAtTime({0.1f, 0.2f, 5}, {0, 0, -1});

Estimates throughSlab(const Gas& gas, float thickness, std::uint64_t n, int maxDepth = 0) {
  SceneKit kit;
  const Medium* medium = make(kit, gas);
  kit.builder.addPrimitive({.shape = kit.box({-2, -2, 0}, {2, 2, thickness}), .media = {medium, nullptr}});
  const auto scene = kit.finish();
  return estimate(*makeVolPath(*scene, {.maxDepth = maxDepth}), kDown, n);
}

TEST(MediumEmission, SlabEmitsWhatItAbsorbs) {
  for (const auto storage : kStorages) {
    for (const float thickness : {0.01f, 1.0f, 2.5f}) {
      const Gas gas{Rgb(0.3f, 2, 10), Rgb(0), Rgb(1, 5, 0.2f), storage};
      const Estimates e = throughSlab(gas, thickness, 1 << 15);
      const RunningStats* channels[] = {&e.red, &e.green, &e.blue};
      for (std::size_t c = 0; c < 3; ++c) {
        const double truth = double{gas.le[c]} * -std::expm1(-double{gas.sigmaA[c]} * double{thickness});
        const ZTest test = zTest(*channels[c], truth);
        EXPECT_LT(std::abs(test.z()), kMaxAbsZ)
            << "thickness " << thickness << ", channel " << c << ": " << test;
      }
      EXPECT_EQ(e.counters.droppedTotal(), 0u);
    }
  }
}

TEST(MediumEmission, GreyHomogeneousSlabHasNoNoiseAtAll) {
  const Estimates e = throughSlab({Rgb(3), Rgb(0), Rgb(2)}, 1, 64);
  for (const Rgb value : e.values) EXPECT_NEAR(value.r, 2 * (1 - std::exp(-3.0)), 1e-6);
}

TEST(MediumEmission, ThinBrightGasIsWithinAPercentAtSixtyFourSamples) {
  for (const auto storage : kStorages) {
    const Estimates e = throughSlab({Rgb(1e-6f), Rgb(0), Rgb(1e6f), storage}, 1, 1 << 12);
    EXPECT_NEAR(e.red.mean(), 1, 1e-3);
    EXPECT_LT(std::sqrt(e.red.variance() / 64), 0.01);
  }
}

TEST(MediumEmission, HotFurnaceIsWhite) {
  for (const double sigmaA : {0.01, 1.0}) {
    for (const double sigmaS : {0.0, 0.3, 3.0}) {
      for (const auto storage : kStorages) {
        SceneKit kit;
        const Gas gas{Rgb(static_cast<float>(sigmaA)), Rgb(static_cast<float>(sigmaS)), Rgb(1), storage};
        const Medium* medium = make(kit, gas);
        kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1.5f), .media = {medium, nullptr}});
        kit.builder.addPrimitive({.shape = kit.sphere({0.3f, 0, 0}, 0.4f), .material = kit.matte(1)});
        kit.sky(1);
        const auto scene = kit.finish();
        EXPECT_EQ(scene->illuminants().size(), 2u);
        const ZTest test = zTest(
            estimate(*makeVolPath(*scene, {.maxDepth = 100000}), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 1 << 12)
                .red,
            1);
        EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << sigmaA << ' ' << sigmaS << ": " << test;
        EXPECT_LT(test.standardError, 0.05) << "a bias of a quarter must be seen";
      }
    }
  }
}

/// Adds the unit ball filled with gas: directly, or as an object that stands so that it looks the same.
void addBall(SceneKit& kit, const Gas& gas, const Placing* placing) {
  if (!placing) {
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {make(kit, gas), nullptr}});
    return;
  }
  const Transform objectFromWorld = placing->worldFromObject.at(double{kTime}).inverse();
  const Medium* medium = make(kit, gas, "gas", {}, placing->mediaFromObject * objectFromWorld);
  // A mirrored sphere is inside out unless it is reversed.
  const Shape* ball = kit.builder.own(std::make_unique<Sphere>(
      Sphere::Params{}, ShapePlacement{objectFromWorld, objectFromWorld.swapsHandedness()}));
  const auto object = kit.builder.addObject({{.shape = ball, .media = {medium, nullptr}}});
  kit.builder.addInstance(object, placing->worldFromObject, placing->mediaFromObject);
}

/// A floor under the ball, seen from above.
std::unique_ptr<Scene> glowingBall(const Gas& gas, const Placing* placing = nullptr) {
  SceneKit kit;
  addBall(kit, gas, placing);
  kit.builder.addPrimitive({.shape = kit.square(-2, 10), .material = kit.matte(0.5f)});
  return kit.finish();
}
const Ray kAtFloor = rayAtTime({2, 0, -1}, {-2, 0, -1});  // reaches it below the ball's centre

/// Always picks the first light, a dark one: emission is found by distances alone.
class PicksTheDark final : public LightSelector {
 public:
  Choice choose(const LightReceiver&, float) const override { return {0, 1}; }
  float probability(const LightReceiver&, std::size_t light) const override {
    return light == 0 ? 1.0f : 0.0f;
  }
};
/// Estimates in glowingBall() by distance sampling alone.
Estimates unlit(const Gas& gas, const Placing* placing, const PathParams& params, const Ray& ray,
                std::uint64_t n) {
  SceneKit kit;
  addBall(kit, gas, placing);
  kit.builder.addPrimitive({.shape = kit.square(-2, 10), .material = kit.matte(0.5f)});
  kit.pointLight({9, 9, 9}, 0);
  const auto scene = kit.finish();
  const VolPathIntegrator integrator(*scene, params, std::make_unique<PicksTheDark>(),
                                     CameraMedium(*scene, kFarAway, 0, nullptr));
  return estimate(integrator, ray, n, 2);
}

TEST(MediumEmission, LightSamplesHelpFarFromTheGas) {
  // Eight radii away few scattered rays find the ball.
  const Ray far = rayAtTime({9, 0, -1}, {-1, 0, -1});
  const Ray near = kAtFloor;
  for (const auto storage : kStorages) {
    const Gas gas{Rgb(0.7f), Rgb(0), Rgb(3), storage};
    const auto lit = glowingBall(gas);
    const auto errors = [&](const Ray& ray) {
      return std::pair{estimate(*makeVolPath(*lit, {.maxDepth = 1}), ray, 1 << 15).red.standardError(),
                       unlit(gas, nullptr, {.maxDepth = 1}, ray, 1 << 15).red.standardError()};
    };
    const auto [farWith, farWithout] = errors(far);
    // Of the grid, which reaches far beyond the ball, two per cent are in it.
    EXPECT_LT(farWith, (storage == Gas::Storage::Grid ? 0.6 : 0.1) * farWithout);
    // Below the ball, where scattered rays do as well, they do no harm.
    const auto [nearWith, nearWithout] = errors(near);
    EXPECT_LT(nearWith, 1.1 * nearWithout);
  }
}

/// What kAtFloor sees of a ball of this sigma_a that emits 3.
double floorUnderBall(double sigma) {
  const double h = 2, kd = 0.5;
  double truth = 0;
  constexpr int kSteps = 100000;
  const double edge = std::asin(1 / h);
  for (int i = 0; i < kSteps; ++i) {
    const double a = (i + 0.5) * edge / kSteps, s = std::sin(a);
    const double chord = 2 * std::sqrt(std::max(0.0, 1 - h * h * s * s));
    truth += kd * 2 * std::cos(a) * s * 3 * -std::expm1(-sigma * chord) * edge / kSteps;
  }
  return truth;
}

TEST(MediumEmission, FloorUnderAGlowingBallEqualsQuadrature) {
  const double truth = floorUnderBall(double{0.7f});
  for (const auto storage : kStorages) {
    const Gas gas{Rgb(0.7f), Rgb(0), Rgb(3), storage};
    const auto lit = glowingBall(gas);
    EXPECT_EQ(lit->illuminants().size(), 1u);
    const Estimates a = estimate(*makeVolPath(*lit, {.maxDepth = 1}), kAtFloor, 1 << 17),
                    b = unlit(gas, nullptr, {.maxDepth = 1}, kAtFloor, 1 << 17);
    const ZTest with = zTest(a.red, truth), without = zTest(b.red, truth);
    EXPECT_LT(std::abs(with.z()), kMaxAbsZ) << with;
    EXPECT_LT(std::abs(without.z()), kMaxAbsZ) << without;
    // Negative control: light samples and scattered rays without their weights count twice.
    EXPECT_GT(zTest(a.red, truth / 2).z(), kMaxAbsZ);
    EXPECT_GT(zTest(a.red, truth * 0.97).z(), kMaxAbsZ) << "three percent are seen";
  }
}

TEST(PlacedEmission, LightsTheFloorAsIfPlacedDirectly) {
  const double truth = floorUnderBall(double{0.7f});
  for (const Placing& placing : placings()) {
    for (const auto storage : kStorages) {
      const Gas gas{Rgb(0.7f), Rgb(0), Rgb(3), storage};
      const auto lit = glowingBall(gas, &placing);
      EXPECT_EQ(lit->lights().size(), 0u);
      EXPECT_EQ(lit->illuminants().size(), 1u);
      const Estimates a = estimate(*makeVolPath(*lit, {.maxDepth = 1}), kAtFloor, 1 << 16),
                      b = unlit(gas, &placing, {.maxDepth = 1}, kAtFloor, 1 << 16);
      const ZTest with = zTest(a.red, truth), without = zTest(b.red, truth);
      EXPECT_LT(std::abs(with.z()), kMaxAbsZ) << placing.name << ": " << with;
      EXPECT_LT(std::abs(without.z()), kMaxAbsZ) << placing.name << ": " << without;
      // The box around a turned ball is large, and many of its points are outside the ball.
      if (storage == Gas::Storage::Homogeneous && placing.name == std::string("translated")) {
        EXPECT_LT(with.standardError, 0.7 * without.standardError) << "light samples must help";
      }
      EXPECT_GT(zTest(a.red, truth * 0.95).z(), kMaxAbsZ) << "five percent are seen";
    }
  }
}

TEST(PlacedEmission, OfScatteringGasLooksAsIfPlacedDirectly) {
  const PathParams params{.maxDepth = 6};
  for (const auto storage : kStorages) {
    const Gas gas{Rgb(0.5f, 0.2f, 1), Rgb(2, 1, 0.5f), Rgb(1, 2, 3), storage};
    const Estimates direct = estimate(*makeVolPath(*glowingBall(gas), params), kDown, 1 << 14);
    for (const Placing& placing : placings()) {
      const Estimates placed = estimate(*makeVolPath(*glowingBall(gas, &placing), params), kDown, 1 << 14, 2);
      EXPECT_EQ(placed.counters.mediumMismatches, 0u);
      for (const auto& [x, y] : {std::pair{&direct.red, &placed.red},
                                 {&direct.green, &placed.green},
                                 {&direct.blue, &placed.blue}}) {
        const ZTest same = zTest(*x, *y);
        EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << placing.name << ": " << same;
      }
    }
  }
}

TEST(PlacedEmission, HotFurnaceIsWhite) {
  for (const Placing& placing : placings()) {
    for (const auto storage : kStorages) {
      SceneKit kit;
      addBall(kit, {Rgb(0.5f), Rgb(1), Rgb(1), storage}, &placing);
      kit.builder.addPrimitive({.shape = kit.sphere({0.3f, 0, 0}, 0.4f), .material = kit.matte(1)});
      kit.sky(1);
      const auto scene = kit.finish();
      EXPECT_EQ(scene->illuminants().size(), 2u);
      const ZTest test = zTest(estimate(*makeVolPath(*scene, {.maxDepth = 100000}),
                                        rayAtTime({0.3f, 0.2f, 5}, {0, 0, -1}), 1 << 12)
                                   .red,
                               1);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << placing.name << ": " << test;
      EXPECT_LT(test.standardError, 0.03) << "a bias of a sixth must be seen";
    }
  }
}

TEST(PlacedEmission, EveryPlacementIsALightOfItsOwn) {
  // The same box three times, once scaled to 24 times its volume: that many times the power.
  SceneKit kit;
  const Medium* gas = make(kit, {Rgb(2), Rgb(0), Rgb(3)});
  const Medium* smoke = kit.fog("smoke", Rgb(1), Rgb(1));
  const auto object =
      kit.builder.addObject({{.shape = kit.box({0, 0, 0}, {1, 1, 1}), .media = {gas, nullptr}},
                             {.shape = kit.box({4, 0, 0}, {5, 1, 1}), .media = {smoke, gas}}});
  kit.builder.addPrimitive({.shape = kit.box({0, 0, 9}, {1, 1, 10}), .media = {gas, nullptr}});
  kit.builder.addInstance(object, AnimatedTransform(Transform::translate({0, 5, 0})));
  kit.builder.addInstance(object, AnimatedTransform(Transform::scale(2, -3, 4)));
  const auto scene = kit.finish();
  ASSERT_EQ(scene->illuminants().size(), 3u);
  // Of what a cube of edge 1 emits, the share that escapes along its mean chord.
  const float power = 4 * kPi * 6 * static_cast<float>(-std::expm1(-2 * 2.0 / 3) / (2 * 2.0 / 3));
  for (const auto& [number, volume] : {std::pair{0u, 1.0f}, {1u, 1.0f}, {2u, 24.0f}}) {
    const MediumLight& light = *scene->mediumLight(number);
    EXPECT_EQ(scene->lightOf(light.medium()), number);
    EXPECT_NEAR(light.power().r, power * volume, 1e-4f * power * volume);
    const Point3f from{7, 8, 20};
    for (const Point2f u : {Point2f(0.1f, 0.2f), Point2f(0.9f, 0.4f)}) {
      const LightSample s = light.sampleDirection(from, u, kTime);
      const auto span = light.span(from, s.wi, kTime);
      ASSERT_TRUE(span);
      const double pdf = (std::pow(span->tMax, 3) - std::pow(span->tMin, 3)) / (3 * double{volume});
      EXPECT_NEAR(s.pdf, pdf, 1e-4 * pdf);
      EXPECT_NEAR(light.directionPdf(from, s.wi, kTime), pdf, 1e-4 * pdf);
      EXPECT_NEAR(s.distance, span->tMax, 1e-6 * span->tMax);
      // For the selection of lights all of it shines from the point that the direction was chosen by.
      const double arriving = light.arrivingLuminance(from, u),
                   emitted = double{light.power().luminance()} / (4 * double{kPi});
      EXPECT_GE(arriving * sqr(span->tMax), emitted * (1 - 1e-4));
      EXPECT_LE(arriving * sqr(span->tMin), emitted * (1 + 1e-4));
    }
  }
}

TEST(PlacedEmission, OfAMediumAroundTheObjectIsNotTheObjects) {
  SceneKit kit;
  const Medium* gas = make(kit, {Rgb(2), Rgb(0), Rgb(3)});
  const auto object = kit.builder.addObject(
      {{.shape = kit.sphere({0, 0, 0}, 1), .media = {kit.fog("fog", Rgb(1), Rgb(1)), gas}}});
  kit.builder.addPrimitive({.shape = kit.box({-9, -9, -9}, {9, 9, 9}), .media = {gas, nullptr}});
  kit.builder.addInstance(object, AnimatedTransform(kSkew));
  const auto scene = kit.finish();
  ASSERT_EQ(scene->illuminants().size(), 1u);
  EXPECT_EQ(scene->mediumLight(0)->medium().placement, nullptr);
}

TEST(MediumEmission, EverySelectionStrategyFindsTheGas) {
  const auto build = [] {
    SceneKit kit;
    const Medium* medium = make(kit, {Rgb(0.5f), Rgb(1), Rgb(2), Gas::Storage::Grid});
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {medium, nullptr}});
    kit.builder.addPrimitive({.shape = kit.square(-2, 10), .material = kit.matte(0.5f)});
    kit.pointLight({3, 0, 2}, 5);
    kit.sky(0.1f);
    return kit.finish();
  };
  const auto scene = build();
  const PathParams params{.maxDepth = 4};
  const Estimates uniform = estimate(*makeVolPath(*scene, params), kAtFloor, 1 << 15);
  for (const LightStrategy strategy : {LightStrategy::Power, LightStrategy::Spatial}) {
    const VolPathIntegrator integrator(*scene, params,
                                       makeLightSelector(strategy, scene->illuminants(), scene->bounds()),
                                       CameraMedium(*scene, kFarAway, 0, nullptr));
    const ZTest same = zTest(estimate(integrator, kAtFloor, 1 << 15, 2).red, uniform.red);
    EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
  }
}

TEST(MediumEmission, LightSamplingDoesNotChangeTheMeanOfScatteringGas) {
  for (const auto storage : kStorages) {
    const Gas gas{Rgb(0.5f, 0.2f, 1), Rgb(2, 1, 0.5f), Rgb(1, 2, 3), storage};
    const PathParams params{.maxDepth = 6};
    const Estimates a = estimate(*makeVolPath(*glowingBall(gas), params), kDown, 1 << 15),
                    b = unlit(gas, nullptr, params, kDown, 1 << 15);
    for (const auto& [x, y] : {std::pair{&a.red, &b.red}, {&a.green, &b.green}, {&a.blue, &b.blue}}) {
      const ZTest same = zTest(*x, *y);
      EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
    }
  }
}

TEST(MediumEmission, OverlappingGasesAddUp) {
  const OverlapRule add{OverlapRule::Mode::Add};
  const auto build = [&](bool split) {
    SceneKit kit;
    const Shape* ball = kit.sphere({0, 0, 0}, 1);
    if (split) {
      for (const auto storage : kStorages) {
        const Medium* part = make(kit, {Rgb(0.4f), Rgb(0.5f), Rgb(2), storage},
                                  storage == Gas::Storage::Grid ? "a" : "b", add);
        kit.builder.addPrimitive({.shape = ball, .media = {part, nullptr}});
        ball = kit.sphere({0, 0, 0}, 1);
      }
    } else {
      kit.builder.addPrimitive({.shape = ball, .media = {make(kit, {Rgb(0.8f), Rgb(1), Rgb(2)}), nullptr}});
    }
    kit.builder.addPrimitive({.shape = kit.square(-2, 10), .material = kit.matte(0.5f)});
    return kit.finish();
  };
  const auto one = build(false), two = build(true);
  for (const Ray& ray : {kDown, kAtFloor}) {
    const ZTest same = zTest(estimate(*makeVolPath(*one), ray, 1 << 15).red,
                             estimate(*makeVolPath(*two), ray, 1 << 15, 2).red);
    EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
  }
}

TEST(MediumEmission, VaryingDensityAndPatternEqualQuadrature) {
  SceneKit kit;
  GridMediumParams p;
  p.name = "fire";
  p.sigmaA = Rgb(1.5f);
  p.sigmaS = Rgb(0);
  p.le = Rgb(2);
  p.grid.nx = p.grid.ny = p.grid.nz = 3;
  GridField::Params factors = p.grid;
  for (int i = 0; i < 27; ++i) {
    p.grid.density.push_back(static_cast<float>(i % 4));
    factors.density.push_back(i % 3 == 0 ? 0.0f : static_cast<float>(i % 5));
  }
  p.grid.p0 = factors.p0 = {-1, -1, -1};
  p.grid.p1 = factors.p1 = {1, 1, 1};
  p.emissionPattern = makeScalePattern(factors, Transform());
  const Medium* fire = kit.builder.own(makeGridMedium(p, Transform()));
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fire, nullptr}});
  const auto scene = kit.finish();
  const GridField density(p.grid, Transform()), factor(factors, Transform());
  double truth = 0, depth = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double step = 2.0 / kSteps;
    const Point3f x{0.1f, 0.2f, static_cast<float>(1 - (i + 0.5) * step)};
    const double sigma = 1.5 * double{density.densityAt(x)};
    truth += std::exp(-depth - sigma * step / 2) * sigma * 2 * double{factor.densityAt(x)} * step;
    depth += sigma * step;
  }
  const ZTest test = zTest(estimate(*makeVolPath(*scene, {.maxDepth = 0}), kDown, 1 << 15).red, truth);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(MediumEmission, TemperatureGridEqualsConstantBlackBody) {
  for (const float kelvin : {1000.0f, 3000.0f, 6500.0f}) {
    SceneKit kit;
    GridMediumParams p;
    p.name = "fire";
    p.sigmaA = Rgb(2);
    p.sigmaS = Rgb(0);
    p.le = Rgb(3);
    p.grid.nx = p.grid.ny = p.grid.nz = 2;
    p.grid.border = GridBorder::Clamp;
    p.grid.density.assign(8, 1.0f);
    p.grid.p0 = {-1, -1, 0};
    p.grid.p1 = {1, 1, 1};
    GridField::Params temperatures = p.grid;
    temperatures.density.assign(8, 20 + kelvin / 1000);
    p.emissionPattern = makeBlackbodyPattern(temperatures, {.scale = 1000, .offset = 20}, Transform());
    const Medium* fire = kit.builder.own(makeGridMedium(p, Transform()));
    kit.builder.addPrimitive({.shape = kit.box({-1, -1, 0}, {1, 1, 1}), .media = {fire, nullptr}});
    const auto scene = kit.finish();
    const Rgb expected = blackbodyToRgb(kelvin, 3).nonNegative() * static_cast<float>(-std::expm1(-2.0));
    const Estimates e = estimate(*makeVolPath(*scene, {.maxDepth = 0}), kDown, 1 << 14);
    const RunningStats* channels[] = {&e.red, &e.green, &e.blue};
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(channels[c]->mean(), double{expected[c]},
                  kMaxAbsZ * channels[c]->standardError() + 1e-3 * double{expected.max()})
          << kelvin << " K, channel " << c;
    }
  }
}

TEST(MediumEmission, PathIgnoresIt) {
  const auto scene = glowingBall({Rgb(1), Rgb(0), Rgb(5)});
  EXPECT_EQ(estimate(*makePath(*scene), kAtFloor, 64).red.mean(), 0);
  EXPECT_TRUE(scene->lights().empty());
}

/// A grid with empty cells, turned.
std::unique_ptr<Medium> patchyFire(float sigma) {
  GridMediumParams p;
  p.name = "fire";
  p.sigmaA = Rgb(sigma);
  p.le = Rgb(1);
  p.bounds.cells = std::array{4, 4, 4};
  p.grid.nx = p.grid.ny = p.grid.nz = 8;
  for (int i = 0; i < 512; ++i) p.grid.density.push_back(static_cast<float>(i % 64 > 40 ? i % 7 : 0));
  p.grid.p0 = {-1, -2, -1};
  p.grid.p1 = {1, 2, 3};
  return makeGridMedium(p, Transform::rotate(30, {1, 2, 3}));
}

TEST(MediumLight, DensitiesAreThoseOfItsSamples) {
  const Placement skewed(0, AnimatedTransform(kSkew));
  for (const float sigma : {1.0f, 1000.0f}) {
    const std::unique_ptr<Medium> fire = patchyFire(sigma);
    const std::unique_ptr<const EmissionVolume> volume = fire->emissionVolume({});
    for (const Placement* placement : {static_cast<const Placement*>(nullptr), &skewed}) {
      const MediumLight light({fire.get(), placement}, *volume);
      // From outside, and from between its cells.
      for (const Point3f x :
           {Point3f(4, 1, 2), Point3f(placement ? 1.2f : 0.1f, placement ? -1.8f : 0.2f, 3)}) {
        // Where does a direction of the sphere lie? The density integrates to 1, and samples follow it.
        Rng rng(3);
        RunningStats whole, up, upOfSamples;
        for (int i = 0; i < 1 << 17; ++i) {
          const float z = 2 * rng.uniform() - 1, phi = 2 * kPi * rng.uniform();
          const float r = std::sqrt(1 - z * z);
          const Vector3f d{r * std::cos(phi), r * std::sin(phi), z};
          const double density = light.directionPdf(x, d, kTime) * 4 * kPi;
          whole.add(density);
          const auto isUp = [](Vector3f v) { return v.z + 0.3f * v.x > 0.1f; };
          up.add(isUp(d) ? density : 0);
          const LightSample s = light.sampleDirection(x, {rng.uniform(), rng.uniform()}, kTime);
          ASSERT_GT(s.pdf, 0);
          upOfSamples.add(isUp(s.wi) ? 1 : 0);
          if (i >= 1000) continue;
          EXPECT_NEAR(light.directionPdf(x, s.wi, kTime), s.pdf, 1e-4 * double{s.pdf}) << i;
          const auto span = light.span(x, s.wi, kTime);
          ASSERT_TRUE(span) << i;
          EXPECT_GE(double{s.distance}, span->tMax);
        }
        const ZTest one = zTest(whole, 1), same = zTest(up, upOfSamples);
        EXPECT_LT(std::abs(one.z()), kMaxAbsZ) << sigma << ": " << one;
        EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << sigma << ": " << same;
        EXPECT_LT(one.standardError, 0.02);
      }
    }
  }
}

/// The density of a direction is the integral of t² times that of the points along it, by quadrature.
TEST(MediumLight, DensityOfPointsIsThatOfTheirDirectionsTakenApart) {
  const Placement skewed(0, AnimatedTransform(kSkew));
  SceneKit kit;
  const Medium* const gas = make(kit, {Rgb(1), Rgb(0), Rgb(2), Gas::Storage::Homogeneous});
  const std::unique_ptr<Medium> fire = patchyFire(1);
  for (const Medium* medium : {gas, static_cast<const Medium*>(fire.get())}) {
    const std::unique_ptr<const EmissionVolume> volume = medium->emissionVolume({{-1, 0, 0}, {1, 1, 2}});
    ASSERT_NE(volume, nullptr);
    for (const Placement* placement : {static_cast<const Placement*>(nullptr), &skewed}) {
      const MediumLight light({medium, placement}, *volume);
      const Point3f x{4, 1, 2};
      Rng rng(5);
      for (int i = 0; i < 100; ++i) {
        const Point2f u{rng.uniform(), rng.uniform()};
        const Point3f inside = light.samplePoint(u, kTime);
        EXPECT_GT(light.pointPdf(inside, kTime), 0) << i;
        const Vector3f d = normalize(inside - x);
        constexpr int kSteps = 20000;
        constexpr double kStep = 12.0 / kSteps;
        double sum = 0;
        for (int k = 0; k < kSteps; ++k) {
          const double t = (k + .5) * kStep;
          sum += t * t * light.pointPdf(Point3f(Vec3d(x) + t * Vec3d(d)), kTime) * kStep;
        }
        // Each border that the line crosses is found within a step.
        const double truth = light.directionPdf(x, d, kTime);
        EXPECT_NEAR(sum, truth, 1e-2 * truth + 1e-4) << i;
      }
    }
  }
}

TEST(MediumLight, PowerIsThatOfItsVolumeWhenThinAndOfItsSurfaceWhenDense) {
  SceneKit kit;
  for (const auto storage : kStorages) {
    const auto powerOf = [&](float sigma) {
      SceneKit own;
      const Medium* medium = make(own, {Rgb(sigma), Rgb(0), Rgb(2), storage});
      const float edge = storage == Gas::Storage::Grid ? 6.0f : 1.0f;
      const auto volume = medium->emissionVolume({{0, 0, 0}, {1, 1, 1}});
      return MediumLight({medium, nullptr}, *volume).power().r / (edge * edge);
    };
    const float edge = storage == Gas::Storage::Grid ? 6.0f : 1.0f;
    EXPECT_NEAR(powerOf(1e-4f), 4 * kPi * 2e-4f * edge, 1e-3f * powerOf(1e-4f));
    // Radiance 2 from a surface of 6: pi L A.
    for (const float sigma : {1e3f, 1e6f}) EXPECT_NEAR(powerOf(sigma), kPi * 2 * 6, 0.02f * powerOf(sigma));
  }
}

TEST(MediumLight, PowerOfAPatternedMediumIsThatOfItsPointsNotOfTheirBounds) {
  // Hot in the middle of a cloud: the bounds of cells say several times what is there, and light selection
  // would look at hardly anything else.
  GridMediumParams p;
  p.name = "fire";
  p.sigmaA = Rgb(1e-3f);
  p.sigmaS = Rgb(0);
  p.le = Rgb(1000);
  p.bounds.cells = std::array{6, 6, 6};
  p.grid.nx = p.grid.ny = p.grid.nz = 24;
  p.grid.p0 = {-1, -1, -1};
  p.grid.p1 = {1, 1, 1};
  GridField::Params temperatures = p.grid;
  for (int i = 0; i < 24 * 24 * 24; ++i) {
    const double x = i % 24 - 11.5, y = i / 24 % 24 - 11.5, z = i / 576 - 11.5;
    const double r2 = (x * x + y * y + z * z) / (12 * 12);
    p.grid.density.push_back(static_cast<float>(std::exp(-r2)));
    temperatures.density.push_back(static_cast<float>(3200 * std::exp(-0.3 * r2)));
  }
  p.emissionPattern = makeBlackbodyPattern(temperatures, {}, Transform());
  const std::unique_ptr<Medium> fire = makeGridMedium(p, Transform());
  RenderCounters counters;
  constexpr int kPoints = 48, kPerCell = kPoints / 6;
  double truth = 0, ofBounds = 0;
  std::array<double, 216> most{};
  for (int z = 0; z < kPoints; ++z) {
    for (int y = 0; y < kPoints; ++y) {
      for (int x = 0; x < kPoints; ++x) {
        const auto at = [](int i) { return static_cast<float>(2 * (i + 0.5) / kPoints - 1); };
        const Rgb e = fire->at({at(x), at(y), at(z)}, counters).emission;
        const double emitted = double{e.r} + double{e.g} + double{e.b};
        double& cell = most[static_cast<std::size_t>((z / kPerCell * 6 + y / kPerCell) * 6 + x / kPerCell)];
        cell = std::max(cell, emitted);
        truth += emitted * 8 / (kPoints * kPoints * kPoints);
      }
    }
  }
  for (const double cell : most) ofBounds += cell * 8 / 216;
  const auto volume = fire->emissionVolume({});
  const Rgb power = MediumLight({fire.get(), nullptr}, *volume).power() / (4 * kPi);
  EXPECT_NEAR(double{power.r} + double{power.g} + double{power.b}, truth, 0.1 * truth);
  EXPECT_GT(ofBounds, 1.5 * truth) << "or this test tells nothing";
}

TEST(MediumEmission, FloorUnderADenseBallIsThatOfASurfaceWithBoundedNoise) {
  // Of every density the same noise, and of the limit the same light as of a surface.
  for (const auto storage : kStorages) {
    double thin = 0;
    for (const float sigma : {5.0f, 50.0f, 500.0f, 5000.0f, 1e6f}) {
      const auto scene = glowingBall({Rgb(sigma), Rgb(0), Rgb(3), storage});
      const Estimates e = estimate(*makeVolPath(*scene, {.maxDepth = 1}), kAtFloor, 1 << 14);
      const ZTest test = zTest(e.red, floorUnderBall(double{sigma}));
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "sigma_a " << sigma << ": " << test;
      if (thin == 0) thin = test.standardError;
      EXPECT_LT(test.standardError, 1.3 * thin) << "sigma_a " << sigma;
      EXPECT_EQ(e.counters.droppedTotal(), 0u);
    }
    EXPECT_NEAR(floorUnderBall(1e6), 0.5 * 3 / 4, 1e-4) << "a Lambertian sphere from two radii";
  }
}

TEST(MediumEmission, LightSamplesAndHitsAgreeInDenseColouredGas) {
  for (const auto storage : kStorages) {
    for (const Rgb sigmaS : {Rgb(0), Rgb(30, 300, 3)}) {
      const Gas gas{Rgb(40, 400, 4), sigmaS, Rgb(1, 2, 3), storage};
      const PathParams params{.maxDepth = 3};
      for (const Ray& ray : {kDown, kAtFloor}) {
        const Estimates a = estimate(*makeVolPath(*glowingBall(gas), params), ray, 1 << 13),
                        b = unlit(gas, nullptr, params, ray, 1 << 13);
        for (const auto& [x, y] : {std::pair{&a.red, &b.red}, {&a.green, &b.green}, {&a.blue, &b.blue}}) {
          const ZTest same = zTest(*x, *y);
          EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
        }
      }
    }
  }
}

TEST(PlacedEmission, OfADenseBallHasBoundedNoise) {
  const double truth = floorUnderBall(5000);
  for (const Placing& placing : placings()) {
    for (const auto storage : kStorages) {
      const auto scene = glowingBall({Rgb(5000), Rgb(0), Rgb(3), storage}, &placing);
      const ZTest test = zTest(estimate(*makeVolPath(*scene, {.maxDepth = 1}), kAtFloor, 1 << 14).red, truth);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << placing.name << ": " << test;
      EXPECT_LT(test.standardError, 0.02 * truth) << placing.name;
    }
  }
}

TEST(MediumEmission, FromWithinADenseGasEveryDirectionShinesAlike) {
  // A white ball in gas of sigma_a Le that nothing leaves: it reflects all of what it gets, Le.
  for (const auto storage : kStorages) {
    for (const float sigma : {20.0f, 2e4f}) {
      SceneKit kit;
      const Medium* medium = make(kit, {Rgb(sigma), Rgb(0), Rgb(3), storage});
      kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 2), .media = {medium, nullptr}});
      kit.builder.addPrimitive({.shape = kit.square(0, 1.5f), .material = kit.matte(0.5f)});
      const auto scene = kit.finish();
      const VolPathIntegrator integrator(
          *scene, {.maxDepth = 1},
          makeLightSelector(LightStrategy::Uniform, scene->illuminants(), scene->bounds()),
          CameraMedium(*scene, {0, 0, 1e-5f}, 0, medium));
      const Estimates e = estimate(integrator, rayAtTime({0, 0, 1e-5f}, {0.1f, 0, -1}), 1 << 14);
      const double near = std::exp(-double{sigma} * 1e-5 * std::sqrt(1.01));
      const ZTest test = zTest(e.red, 3 * (1 - near) + near * 0.5 * 3);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << sigma << ": " << test;
      EXPECT_LT(test.standardError, 0.05);
    }
  }
}

TEST(MediumEmission, SharpEdgesInsideSuperVoxelsCostNoNoise) {
  // Dense behind a step that the super-voxel, one for all, knows nothing of.
  for (const float sigma : {2.0f, 6.0f, 20.0f, 200.0f, 2e3f}) {
    SceneKit kit;
    GridMediumParams p;
    p.name = "fire";
    p.sigmaA = Rgb(sigma, sigma / 2, sigma);
    p.sigmaS = Rgb(0);
    p.le = Rgb(2, 3, 4);
    p.bounds.cells = std::array{1, 1, 1};
    p.grid.nx = p.grid.ny = 1;
    p.grid.nz = 40;
    p.grid.border = GridBorder::Clamp;
    for (int i = 0; i < 40; ++i) p.grid.density.push_back(i < 13 ? 1.0f : 0.0f);
    p.grid.p0 = {-2, -2, -1};
    p.grid.p1 = {2, 2, 1};
    const Medium* fire = kit.builder.own(makeGridMedium(p, Transform()));
    kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fire, nullptr}});
    const auto scene = kit.finish();
    const Estimates e = estimate(*makeVolPath(*scene, {.maxDepth = 0}), kDown, 1 << 11);
    const double depth = double{sigma} * 2 * 13 / 40;
    const std::array truths = {2 * -std::expm1(-depth), 3 * -std::expm1(-depth / 2), 4 * -std::expm1(-depth)};
    const std::array channels = {&e.red, &e.green, &e.blue};
    for (std::size_t c = 0; c < 3; ++c) {
      const ZTest test = zTest(*channels[c], truths[c]);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << sigma << ": " << test;
      EXPECT_LT(test.standardError, 0.03 * truths[c]) << sigma << ", channel " << c;
    }
  }
}

TEST(MediumEmission, LookupsOfLightSamplesAreCounted) {
  // One point of a floor: the light sample looks, and the ray that scattering sends on.
  const Gas gas{Rgb(0.05f), Rgb(0), Rgb(3), Gas::Storage::Grid};
  const auto lit = glowingBall(gas);
  const auto lookups = [&](const Estimates& e) { return e.counters.densityLookups; };
  const Estimates with = estimate(*makeVolPath(*lit, {.maxDepth = 1}), kAtFloor, 1 << 10),
                  without = unlit(gas, nullptr, {.maxDepth = 1}, kAtFloor, 1 << 10);
  // Light samples meet the ball about as often as they hit its box, and look at least once each time.
  EXPECT_GT(lookups(with), lookups(without) + (1 << 10) / 100);
  // What a medium counts is what there is to count.
  RenderCounters counters;
  Rng rng(1);
  const std::unique_ptr<Medium> fire = patchyFire(1);
  const auto volume = fire->emissionVolume({});
  const MediumLight light({fire.get(), nullptr}, *volume);
  EXPECT_GT(light.arrivingLuminance({4, 1, 2}, {0.3f, 0.6f}), 0) << "and costs no look-up";
  std::uint64_t found = 0;
  for (int i = 0; i < 100; ++i) {
    const LightSample s = light.sampleDirection({4, 1, 2}, {rng.uniform(), rng.uniform()}, 0);
    found += fire->sampleEmission({{4, 1, 2}, s.wi, 0, 20}, rng, counters).count;
  }
  EXPECT_GT(found, 10u);
  EXPECT_GE(counters.densityLookups, found);
}

}  // namespace
}  // namespace pbrtmedia
