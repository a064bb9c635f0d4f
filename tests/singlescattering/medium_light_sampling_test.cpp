// SPDX-License-Identifier: BSD-2-Clause
// Light samples in media of lights that shine from one point, by every way of choosing where.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "lights/distant.h"
#include "lights/projection.h"
#include "lights/spot.h"
#include "media/grid_medium.h"
#include "singlescattering/position_lights.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;
using Sampling = MediumLightSampling;
std::vector<Sampling> allSamplings() {
  std::vector<Sampling> all;
  for (const std::string_view name : alternativeNames<Sampling>())
    all.push_back(*findAlternative<Sampling>(name));
  return all;
}
std::vector<Sampling> samplingsOfStretches() {
  std::vector<Sampling> all = allSamplings();
  std::erase_if(all, [](const Sampling& s) { return !traitsOf(s).onStretches; });
  return all;
}
std::string_view nameOf(const Sampling& s) { return alternativeName(s); }

/// Ways that explore take several light samples of a stretch: fewer paths, for the time of a test.
std::uint64_t pathsOf(const Sampling& s, std::uint64_t n) { return explores(s) ? n / 8 : n; }

/// A scene with its camera ray.
struct Case {
  std::unique_ptr<Scene> scene;
  Ray ray;
};

Estimates singleScattering(const Case& c, const Sampling& sampling, std::uint64_t n, int maxDepth = 1,
                           std::uint64_t seed = 1) {
  return estimate(*makeVolPath(*c.scene, {.maxDepth = maxDepth, .mediumLightSampling = sampling}), c.ray, n,
                  seed);
}

/// The integral over z of what a light at one point scatters toward the camera once: fog of these
/// coefficients between z = -2 and 2, a ray along -z from above. `radiance(p)` and `way(p)`: what arrives at
/// p unattenuated, and how much fog lies between.
double slabIntegral(double sigmaS, double sigmaT, const std::function<double(Point3f)>& radiance,
                    const std::function<double(Point3f)>& way) {
  double sum = 0;
  constexpr int kSteps = 40000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * 4 / kSteps;
    const Point3f p{0, 0, static_cast<float>(2 - t)};
    sum += sigmaS / (4 * M_PI) * std::exp(-sigmaT * (t + way(p))) * radiance(p) * 4 / kSteps;
  }
  return sum;
}

template <class AddLight>
Case slab(Rgb sigmaA, Rgb sigmaS, const AddLight& addLight, int cuts = 0) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", sigmaA, sigmaS);
  kit.builder.addPrimitive({.shape = kit.box({-50, -50, -2}, {50, 50, 2}), .media = {fog, nullptr}});
  // Empty bubbles with the same fog on both sides, which cut the ray into stretches.
  const Medium* same = kit.fog("same", sigmaA, sigmaS);
  for (int i = 0; i < cuts; ++i) {
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 0.3f + 0.4f * static_cast<float>(i)),
                              .media = i % 2 == 0 ? MediumInterface{fog, same} : MediumInterface{same, fog}});
  }
  addLight(kit);
  return {kit.finish(), rayOf({0, 0, 5}, {0, 0, -1})};
}

TEST(MediumLightSampling, PointLightInHomogeneousFogIsExactInEveryChannel) {
  const Rgb sigmaA(0.2f, 0, 0.5f), sigmaS(0.4f, 1.5f, 0.05f);
  const Point3f light{0, 0.2f, 0};
  const Case c = slab(sigmaA, sigmaS, [&](SceneKit& kit) { kit.pointLight(light, 2); });
  const auto way = [&](Point3f p) { return length(Vec3d(p) - Vec3d(light)); };
  for (const Sampling& sampling : allSamplings()) {
    const Estimates e = singleScattering(c, sampling, pathsOf(sampling, 1 << 16));
    const RunningStats* channels[] = {&e.red, &e.green, &e.blue};
    for (std::size_t i = 0; i < 3; ++i) {
      const double truth = slabIntegral(
          sigmaS[i], sigmaA[i] + sigmaS[i], [&](Point3f p) { return 2 / sqr(way(p)); }, way);
      const ZTest test = zTest(*channels[i], truth);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(sampling) << ", channel " << i << ": " << test;
    }
  }
}

TEST(MediumLightSampling, UnweightedSumOfBothIsSeenToBeTooMuch) {
  // Negative control: dropping the weights of the combination counts the light twice, as their sum does.
  const Case c = slab(Rgb(0.2f), Rgb(0.4f), [](SceneKit& kit) { kit.pointLight({0, 0.2f, 0}, 2); });
  const Estimates mis = singleScattering(c, MisSampling{}, 1 << 14),
                  collision = singleScattering(c, CollisionSampling{}, 1 << 14, 1, 2),
                  stretch = singleScattering(c, EquiangularSampling{}, 1 << 14, 1, 3);
  const ZTest unweighted{collision.red.mean() + stretch.red.mean(),
                         mis.red.mean(),
                         std::hypot(collision.red.standardError(), stretch.red.standardError()),
                         mis.red.standardError(),
                         1,
                         1 << 14};
  EXPECT_GT(unweighted.z(), kMaxAbsZ) << unweighted;
}

TEST(MediumLightSampling, IsExactOnStretchesThatBoundariesCut) {
  const Point3f light{0, 0.2f, 0};
  const Case c = slab(
      Rgb(0.2f), Rgb(0.4f), [&](SceneKit& kit) { kit.pointLight(light, 2); }, 4);
  const auto way = [&](Point3f p) { return length(Vec3d(p) - Vec3d(light)); };
  const double truth = slabIntegral(
      0.4, 0.6, [&](Point3f p) { return 2 / sqr(way(p)); }, way);
  for (const Sampling& sampling : allSamplings()) {
    const Estimates e = singleScattering(c, sampling, pathsOf(sampling, 1 << 16));
    const ZTest test = zTest(e.red, truth);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(sampling) << ": " << test;
    EXPECT_EQ(e.counters.mediumMismatches, 0u);
  }
}

TEST(MediumLightSampling, SpotConesAreExactToTheirEdges) {
  // From inside and outside the fog, axis across and along the ray, narrow and wide.
  struct Spot {
    Point3f from, to;
    float angle;
  };
  for (const Spot spot : {Spot{{0, 1, 0}, {0, 0, 0.3f}, 20}, Spot{{0, 0.5f, 1.5f}, {0, 0, -2}, 30},
                          Spot{{0, 0.3f, 0}, {0, 0.3f, -1}, 100}, Spot{{0, 0.1f, 3}, {0, 0, 0}, 15},
                          Spot{{0.2f, 0, -1}, {0, 0, 1}, 5}}) {
    const SpotLight::Params params{.intensity = Rgb(2),
                                   .from = spot.from,
                                   .to = spot.to,
                                   .coneAngle = spot.angle,
                                   .coneDeltaAngle = spot.angle / 3};
    const Case c = slab(Rgb(0.2f), Rgb(0.4f), [&](SceneKit& kit) {
      kit.builder.addLight(std::make_unique<SpotLight>(Transform(), params));
    });
    const SpotLight light(Transform(), params);
    const auto radiance = [&](Point3f p) { return double{light.sample(p, {}).radiance.r}; };
    const auto way = [&](Point3f p) {  // the part below z = 2
      const Vec3d d = Vec3d(spot.from) - Vec3d(p);
      return spot.from.z > 2 ? length(d) * (2 - double{p.z}) / d.z : length(d);
    };
    const double truth = slabIntegral(0.4, 0.6, radiance, way);
    ASSERT_GT(truth, 0);
    for (const Sampling& sampling : allSamplings()) {
      const ZTest test = zTest(singleScattering(c, sampling, pathsOf(sampling, 1 << 15)).red, truth);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(sampling) << ", angle " << spot.angle << ": " << test;
    }
  }
}

/// Light off every stretch's clip must be dark.
TEST(MediumLightSampling, ClippedPartsOfALineAreDark) {
  Rng rng(3);
  const auto anywhere = [&](float size) {
    return Point3f(size * (2 * rng.uniform() - 1), size * (2 * rng.uniform() - 1),
                   size * (2 * rng.uniform() - 1));
  };
  std::size_t lit = 0, cut = 0;
  for (int i = 0; i < 2000; ++i) {
    const Transform place = Transform::translate(Vec3d(anywhere(3))) *
                            Transform::rotate(360 * double{rng.uniform()}, Vec3d(anywhere(1))) *
                            Transform::scale(1, 0.5, 2);
    std::unique_ptr<Light> light;
    if (i % 2 == 0) {
      light = std::make_unique<SpotLight>(
          place, SpotLight::Params{.from = anywhere(1), .to = anywhere(1), .coneAngle = 120 * rng.uniform()});
    } else {
      light = std::make_unique<ProjectionLight>(
          place, ProjectionLight::Params{.fov = 1 + 150 * rng.uniform(), .map = std::nullopt});
    }
    const Point3f o = anywhere(5);
    const Vector3f d = normalize(anywhere(1));
    double tMin = 0, tMax = 20;
    light->clipToLit(Vec3d(o), Vec3d(d), tMin, tMax);
    for (int j = 0; j < 200; ++j) {
      const float t = 0.1f * static_cast<float>(j) + 0.05f;
      const bool isLit = !light->sample(o + t * d, {}).radiance.isBlack();
      const bool isCut = !(double{t} >= tMin && double{t} <= tMax);
      lit += isLit;
      cut += isCut;
      ASSERT_FALSE(isLit && isCut) << light->typeName() << ' ' << i << " at t " << t;
    }
  }
  EXPECT_GT(lit, 10000u);
  EXPECT_GT(cut, 100000u);
}

/// Smoke on a grid with two colours, seen through a second, overlapping fog.
Case smoke() {
  SceneKit kit;
  GridMediumParams grid;
  grid.name = "smoke";
  grid.sigmaA = Rgb(0.3f, 0.5f, 0.1f);
  grid.sigmaS = Rgb(1.2f, 0.6f, 2.0f);
  grid.overlap = {OverlapRule::Mode::Add};
  grid.grid.nx = grid.grid.ny = grid.grid.nz = 3;
  for (int i = 0; i < 27; ++i)
    grid.grid.density.push_back(i % 5 == 0 ? 0.0f : 0.3f * static_cast<float>(i % 7));
  grid.grid.p0 = {-1, -1, -1};
  grid.grid.p1 = {1, 1, 1};
  const Medium* smoke = kit.builder.own(makeGridMedium(grid, Transform()));
  const Medium* fog = kit.fog("fog", Rgb(0.1f), Rgb(0.2f), {OverlapRule::Mode::Add});
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {smoke, nullptr}});
  kit.builder.addPrimitive({.shape = kit.sphere({0.5f, 0, 0.2f}, 1), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.sphere({-0.3f, -0.5f, -0.2f}, 0.2f), .material = kit.matte(0.5f)});
  kit.pointLight({0.2f, 0.1f, 0.3f}, 2);
  kit.pointLight({-2, 3, 1}, 10);
  kit.builder.addLight(std::make_unique<SpotLight>(
      Transform(), SpotLight::Params{.intensity = Rgb(3), .from = {0, 2, 0}, .to = {0, 0, 0}}));
  kit.sky(0.1f);
  return {kit.finish(), rayOf({0.3f, 0.2f, 5}, {0.02f, -0.01f, -1})};
}

TEST(MediumLightSampling, AllAgreeInOverlappingColouredSmokeAtEveryDepth) {
  const Case c = smoke();
  for (const int depth : {1, 4}) {
    const Estimates collision = singleScattering(c, CollisionSampling{}, 1 << 16, depth);
    for (const Sampling& sampling : samplingsOfStretches()) {
      const Estimates e = singleScattering(c, sampling, pathsOf(sampling, 1 << 16), depth, 2);
      for (const auto& [a, b] :
           {std::pair{&collision.red, &e.red}, {&collision.green, &e.green}, {&collision.blue, &e.blue}}) {
        const ZTest same = zTest(*a, *b);
        EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << nameOf(sampling) << ", depth " << depth << ": " << same;
      }
    }
  }
}

TEST(MediumLightSampling, GridSmokeUnderAPointLightEqualsQuadrature) {
  SceneKit kit;
  GridMediumParams grid;
  grid.name = "smoke";
  grid.sigmaA = Rgb(0.5f);
  grid.sigmaS = Rgb(1.5f);
  grid.grid.nx = grid.grid.ny = grid.grid.nz = 2;
  grid.grid.density = {0, 1, 2, 3, 4, 0, 1, 2};
  grid.grid.border = GridBorder::Clamp;
  grid.grid.p0 = {-1, -1, -1};
  grid.grid.p1 = {1, 1, 1};
  const Medium* smoke = kit.builder.own(makeGridMedium(grid, Transform()));
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {smoke, nullptr}});
  const Point3f light{0.3f, 0.2f, 0.1f};
  kit.pointLight(light, 2);
  const Case c{kit.finish(), rayOf({0.1f, 0.05f, 5}, {0, 0, -1})};
  RenderCounters counters;
  const auto sigmaT = [&](Point3f p) { return double{smoke->at(p, counters).sigmaS.r} * 2 / 1.5; };
  double truth = 0, depth = 0;
  constexpr int kSteps = 1000, kWay = 200;
  for (int i = 0; i < kSteps; ++i) {
    const double h = 2.0 / kSteps;
    const Point3f p{0.1f, 0.05f, static_cast<float>(1 - (i + 0.5) * h)};
    const double sigma = sigmaT(p);
    const Vec3d d = Vec3d(light) - Vec3d(p);
    double way = 0;
    for (int j = 0; j < kWay; ++j) way += sigmaT(Point3f(Vec3d(p) + d * ((j + 0.5) / kWay)));
    way *= length(d) / kWay;
    truth += sigma * 0.75 / (4 * M_PI) * std::exp(-depth - sigma * h / 2 - way) * 2 / lengthSquared(d) * h;
    depth += sigma * h;
  }
  for (const Sampling& sampling : allSamplings()) {
    const ZTest test = zTest(singleScattering(c, sampling, pathsOf(sampling, 1 << 16)).red, truth);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(sampling) << ": " << test;
  }
}

TEST(MediumLightSampling, ChangesNothingWithoutSuchALight) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(0.1f), Rgb(0.5f));
  kit.builder.addPrimitive({.shape = kit.box({-2, -2, -2}, {2, 2, 2}), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .material = kit.matte(0.5f)});
  kit.sky(1);
  const Case c{kit.finish(), rayOf({0.3f, 0.2f, 5}, {0.05f, 0.02f, -1})};
  const Estimates collision = singleScattering(c, CollisionSampling{}, 64, 5);
  for (const Sampling& sampling : samplingsOfStretches()) {
    const Estimates e = singleScattering(c, sampling, 64, 5);
    EXPECT_EQ(collision.values, e.values);
    EXPECT_EQ(collision.counters.shadowRays, e.counters.shadowRays);
  }
}

TEST(MediumLightSampling, IsQuietInThinFogAndNotNoisierInDense) {
  const auto noise = [](float sigma, Point3f light, const Sampling& sampling) {
    const Case c = slab(Rgb(0), Rgb(sigma), [&](SceneKit& kit) { kit.pointLight(light, 2); });
    return singleScattering(c, sampling, 1 << 14).red.standardError();
  };
  const Point3f near{0, 0.2f, 0}, far{0, 30, 40};
  for (const Sampling& sampling : samplingsOfStretches()) {
    EXPECT_LT(noise(0.02f, near, sampling),
              (traitsOf(sampling).followsLights ? 0.1 : 0.5) * noise(0.02f, near, CollisionSampling{}))
        << nameOf(sampling);
  }
  EXPECT_LT(noise(10, far, AutoSampling{}), 1.05 * noise(10, far, CollisionSampling{}));
  EXPECT_GT(noise(10, far, EquiangularSampling{}), 1.5 * noise(10, far, CollisionSampling{}));
}

TEST(PositionLights, DensitiesOfManyLightsAreThoseThatAreSampled) {
  // Below and above the number up to which each is weighed.
  for (const int count : {2, 40}) {
    Rng rng(7);
    std::vector<PointLight> points;
    std::vector<const Light*> lights;
    for (int i = 0; i < count; ++i) {
      points.emplace_back(Transform(),
                          PointLight::Params{.intensity = Rgb(1 + rng.uniform()),
                                             .from = {rng.uniform(), rng.uniform(), 3 * rng.uniform()}});
    }
    const DistantLight sun(Transform(), {});  // lights of no position are passed over
    lights.push_back(&sun);
    for (const PointLight& p : points) lights.push_back(&p);
    const PositionLights sampled(lights);
    EXPECT_FALSE(sampled.contains(0));
    const Ray ray = rayOf({0, 0, -1}, {0, 0.1f, 1});
    RunningStats volume;  // the mean of 1/pdf is the length for each light
    for (int i = 0; i < 20000; ++i) {
      const auto choice = sampled.sample({ray, 0.5, 4}, rng.uniform(), rng.uniform());
      ASSERT_TRUE(choice);
      EXPECT_NEAR(sampled.pdf(choice->light, {ray, 0.5, 4}, choice->t), choice->pdf, 1e-6 * choice->pdf);
      volume.add(1 / choice->pdf);
    }
    const ZTest test = zTest(volume, 3.5 * count);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << count << " lights: " << test;
  }
}

}  // namespace
}  // namespace pbrtmedia
