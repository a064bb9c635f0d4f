// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/light_strategy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "base/rng.h"
#include "lighting/spatial_light_selector.h"
#include "lights/distant.h"
#include "lights/infinite.h"
#include "lights/point.h"
#include "lights/spot.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::kMinPValue;

constexpr Bounds3f kBox{{-10, -10, -10}, {10, 10, 10}};
constexpr LightStrategy kStrategies[] = {LightStrategy::Uniform, LightStrategy::Power, LightStrategy::Spatial,
                                         LightStrategy::Tree, LightStrategy::Learned};

/// Lights that differ in kind, place and strength.
class Lights {
 public:
  Lights() : distant_(Transform(), {.radiance = Rgb(0.02f)}), sky_(Transform(), {.radiance = Rgb(0.01f)}) {
    distant_.preprocess(kBox);
    sky_.preprocess(kBox);
  }
  std::vector<const Light*> lights() const { return {&near_, &far_, &away_, &distant_, &sky_}; }
  std::vector<const Illuminant*> all() const {
    const std::vector<const Light*> each = lights();
    return {each.begin(), each.end()};
  }

 private:
  PointLight near_{Transform(), {.intensity = Rgb(1), .from = {-8, 0, 0}}};
  PointLight far_{Transform(), {.intensity = Rgb(2), .from = {20, 5, 0}}};
  /// Lights nothing of the box.
  SpotLight away_{Transform::translate({0, 0, 30}), {.intensity = Rgb(100)}};
  DistantLight distant_;
  InfiniteLight sky_;
};

std::vector<Point3f> somePoints() {
  return {{-7, 0, 0}, {9, 9, -9}, {0.1f, 0.2f, 0.3f}, {9.9f, 4, 0}, {-100, 3, 50}, {10, 10, 10}};
}

TEST(LightSelection, KnowsTheNamesOfTheSceneLanguage) {
  EXPECT_EQ(lightStrategyOfName("uniform"), LightStrategy::Uniform);
  EXPECT_EQ(lightStrategyOfName("power"), LightStrategy::Power);
  EXPECT_EQ(lightStrategyOfName("spatial"), LightStrategy::Spatial);
  EXPECT_EQ(lightStrategyOfName("tree"), LightStrategy::Tree);
  EXPECT_EQ(lightStrategyOfName("learned"), LightStrategy::Learned);
  EXPECT_EQ(lightStrategyOfName("Spatial"), std::nullopt);
  EXPECT_EQ(lightStrategyOfName(""), std::nullopt);
}

TEST(LightSelection, ProbabilitiesArePositiveAndSumToOne) {
  const Lights lights;
  for (const LightStrategy strategy : kStrategies) {
    const auto selector = makeLightSelector(strategy, lights.all(), kBox);
    for (const Point3f p : somePoints()) {
      double sum = 0;
      for (std::size_t i = 0; i < lights.all().size(); ++i) {
        EXPECT_GT(selector->probability(p, i), 0);
        sum += selector->probability(p, i);
      }
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}

TEST(LightSelection, ChoosesWithTheProbabilitiesItStates) {
  const Lights lights;
  for (const LightStrategy strategy : kStrategies) {
    const auto selector = makeLightSelector(strategy, lights.all(), kBox);
    for (const Point3f p : somePoints()) {
      constexpr int kCount = 20000;
      std::vector<double> observed(5), expected(5);
      Rng rng(3);
      for (int i = 0; i < kCount; ++i) {
        const LightSelector::Choice c = selector->choose(p, rng.uniform());
        EXPECT_EQ(c.probability, selector->probability(p, c.light));
        ++observed[c.light];
      }
      for (std::size_t i = 0; i < 5; ++i) expected[i] = double{kCount} * selector->probability(p, i);
      const test::ChiSquareTest t = test::chiSquareTest(observed, expected);
      EXPECT_GT(t.pValue(), test::sidak(kMinPValue, 30)) << t;
    }
  }
}

TEST(LightSelection, AcceptsEveryUniformNumber) {
  const Lights lights;
  for (const LightStrategy strategy : kStrategies) {
    const auto selector = makeLightSelector(strategy, lights.all(), kBox);
    for (const float u :
         {0.0f, std::numeric_limits<float>::denorm_min(), 0.2f, 0.4f, 0.6f, 0.8f, kOneMinusEpsilon}) {
      const LightSelector::Choice c = selector->choose(Point3f{1, 2, 3}, u);
      EXPECT_LT(c.light, 5u);
      EXPECT_GT(c.probability, 0);
    }
  }
}

/// Irradiance of all lights by one light picked per sample, against the sum over the lights.
TEST(LightSelection, EveryStrategyGivesTheSameMean) {
  const Lights lights;
  const Normal3f n = normalize(Vector3f{-0.5f, 0.3f, -0.8f});
  for (const Point3f p : {Point3f{-6, 1, 0}, Point3f{5, -5, 2}}) {
    const auto one = [&](std::size_t i, Rng& rng) {
      const LightSample s = lights.lights()[i]->sample(p, {rng.uniform(), rng.uniform()});
      return s.pdf > 0 ? double{s.radiance.r} * std::max(0.0f, dot(n, s.wi)) / s.pdf : 0;
    };
    double truth = 0.01 * std::numbers::pi;  // the sky
    Rng unused;
    for (std::size_t i = 0; i < 4; ++i) truth += one(i, unused);
    for (const LightStrategy strategy : kStrategies) {
      const auto selector = makeLightSelector(strategy, lights.all(), kBox);
      const auto draw = [&](Rng& rng) {
        const LightSelector::Choice c = selector->choose(p, rng.uniform());
        return one(c.light, rng) / c.probability;
      };
      const test::ZTest z = test::runZTest(draw, truth, 17, 100000);
      EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
    }
  }
}

TEST(LightSelection, UniformGivesAllLightsTheSame) {
  const Lights lights;
  const auto selector = makeLightSelector(LightStrategy::Uniform, lights.all(), kBox);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(selector->probability(Point3f{}, i), 0.2f);
    EXPECT_EQ(selector->choose(Point3f{}, (static_cast<float>(i) + 0.5f) / 5).light, i);
  }
}

TEST(LightSelection, OneLightIsAlwaysChosenAndNothingIsTabulated) {
  const PointLight light(Transform(), {});
  const std::vector<const Illuminant*> lights{&light};
  for (const LightStrategy strategy : kStrategies) {
    const auto selector = makeLightSelector(strategy, lights, kBox);
    EXPECT_EQ(selector->choose(Point3f{1, 2, 3}, 0.9f).light, 0u);
    EXPECT_FALSE(selector->canLearn());
    // PBRT-v3's strategies sample skies in media as it does.
    EXPECT_EQ(selector->leavesOutUniformLights(),
              strategy == LightStrategy::Tree || strategy == LightStrategy::Learned);
    EXPECT_EQ(selector->choose(Point3f{1, 2, 3}, 0.9f).probability, 1);
    EXPECT_EQ(dynamic_cast<const SpatialLightSelector*>(selector.get()), nullptr);
  }
}

TEST(LightSelection, PowerIsProportionalToTheLuminanceOfThePower) {
  const PointLight weak(Transform(), {.intensity = Rgb(1)}), strong(Transform(), {.intensity = Rgb(3)});
  const PointLight green(Transform(), {.intensity = {0, 1, 0}});
  const std::vector<const Illuminant*> lights{&weak, &strong, &green};
  const auto selector = makeLightSelector(LightStrategy::Power, lights, kBox);
  const double total = 4 + 0.715160;
  for (const Point3f p : somePoints()) {
    EXPECT_NEAR(selector->probability(p, 0), 1 / total, 1e-6);
    EXPECT_NEAR(selector->probability(p, 1), 3 / total, 1e-6);
    EXPECT_NEAR(selector->probability(p, 2), 0.715160 / total, 1e-6);
  }
}

TEST(LightSelection, PowerFindsLightsWhosePowerIsEstimatedAsNothing) {
  // Around a scene without extent an infinite light has no power, yet it shines on it.
  const PointLight point(Transform(), {});
  InfiniteLight sky(Transform(), {});
  sky.preprocess({{1, 1, 1}, {1, 1, 1}});
  const std::vector<const Illuminant*> lights{&point, &sky};
  const auto selector = makeLightSelector(LightStrategy::Power, lights, kBox);
  EXPECT_NEAR(selector->probability(Point3f{}, 1), 0.0005, 1e-6);

  const std::vector<const Illuminant*> dark{&sky, &sky};
  EXPECT_EQ(makeLightSelector(LightStrategy::Power, dark, kBox)->probability(Point3f{}, 1), 0.5f);
}

TEST(LightSelection, SpatialFallsBackToPowerWithoutSurfaces) {
  const Lights lights;
  const auto selector = makeLightSelector(LightStrategy::Spatial, lights.all(), {});
  const auto power = makeLightSelector(LightStrategy::Power, lights.all(), {});
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(selector->probability(Point3f{}, i), power->probability(Point3f{}, i));
}

TEST(SpatialLightSelector, WeighsLightsByTheInverseSquareOfTheirDistance) {
  const PointLight a(Transform(), {.intensity = Rgb(1), .from = {-8, 0, 0}});
  const PointLight b(Transform(), {.intensity = Rgb(1), .from = {8, 0, 0}});
  const std::vector<const Illuminant*> lights{&a, &b};
  const SpatialLightSelector selector(lights, kBox);
  // A voxel is 0.3 wide: at 4 and 12 units the mean of 1/r² is that of its centre to a per cent.
  const double expected = (1 / 16.0) / (1 / 16.0 + 1 / 144.0);
  EXPECT_NEAR(selector.probability(Point3f{-4, 0.1f, 0.1f}, 0), expected, 0.01);
  EXPECT_NEAR(selector.probability(Point3f{4, 0.1f, 0.1f}, 1), expected, 0.01);
  EXPECT_GT(selector.probability(Point3f{-8, 0, 0}, 0), 0.99f) << "the voxel that holds the light";
}

TEST(SpatialLightSelector, GivesEveryLightAThousandthOfTheAverage) {
  const PointLight lit(Transform(), {});
  const SpotLight away(Transform::translate({0, 0, 30}), {});
  const std::vector<const Illuminant*> lights{&lit, &away};
  const SpatialLightSelector selector(lights, kBox);
  EXPECT_NEAR(selector.probability(Point3f{1, 2, 3}, 1), 0.001 / 2.001, 1e-7);
}

TEST(SpatialLightSelector, TreatsLightsAlikeWhereNothingArrives) {
  const SpotLight a(Transform::translate({0, 0, 30}), {}), b(Transform::translate({0, 0, 40}), {});
  const std::vector<const Illuminant*> lights{&a, &b};
  EXPECT_EQ(SpatialLightSelector(lights, kBox).probability(Point3f{}, 0), 0.5f);
}

TEST(SpatialLightSelector, FillsOnlyTheVoxelsThatAreAskedFor) {
  const Lights lights;
  const SpatialLightSelector selector(lights.all(), kBox);
  EXPECT_EQ(selector.filledVoxels(), 0u);
  selector.choose(Point3f{1, 1, 1}, 0.5f);
  selector.choose(Point3f{1.01f, 1.01f, 1.01f}, 0.7f);
  EXPECT_EQ(selector.filledVoxels(), 1u);
  selector.probability(Point3f{5, 1, 1}, 0);
  EXPECT_EQ(selector.filledVoxels(), 2u);
}

TEST(SpatialLightSelector, KeepsVoxelsApartInABoxOfUnequalSides) {
  const Lights lights;
  const SpatialLightSelector selector(lights.all(), {{0, 0, 0}, {8, 4, 2}});
  ASSERT_EQ(selector.resolution(), (Point3i{64, 32, 16}));
  std::size_t asked = 0;
  for (int z = 0; z < 16; ++z) {
    for (int y = 0; y < 32; ++y) {
      const auto middle = [](int voxel) { return (static_cast<float>(voxel) + 0.5f) / 8; };
      selector.probability(Point3f{middle(5), middle(y), middle(z)}, 0);
      EXPECT_EQ(selector.filledVoxels(), ++asked) << y << ' ' << z;
    }
  }
}

TEST(SpatialLightSelector, AnswersTheSameWhateverThreadAsksFirst) {
  const Lights lights;
  const SpatialLightSelector alone(lights.all(), kBox), shared(lights.all(), kBox);
  constexpr std::size_t kPoints = 2000, kThreads = 4;
  std::vector<Point3f> points;
  Rng rng(12);
  for (std::size_t i = 0; i < kPoints; ++i) {  // few voxels, so that threads meet in them
    points.push_back({2 * rng.uniform() - 1, 2 * rng.uniform() - 1, 2 * rng.uniform() - 1});
  }
  std::vector<float> found(kPoints);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < kPoints; i += kThreads) found[i] = shared.probability(points[i], i % 5);
    });
  }
  for (std::thread& t : threads) t.join();
  for (std::size_t i = kPoints; i-- > 0;) EXPECT_EQ(alone.probability(points[i], i % 5), found[i]);
  EXPECT_EQ(alone.filledVoxels(), shared.filledVoxels());
}

TEST(SpatialLightSelector, UsesTheNearestVoxelOutsideTheBoxAndForNaN) {
  const Lights lights;
  const SpatialLightSelector selector(lights.all(), kBox);
  EXPECT_EQ(selector.probability(Point3f{1e30f, 0, 0}, 1), selector.probability(Point3f{9.99f, 0, 0}, 1));
  EXPECT_EQ(selector.probability(Point3f{-1e30f, 0, 0}, 1), selector.probability(Point3f{-9.99f, 0, 0}, 1));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_GT(selector.probability(Point3f{nan, nan, nan}, 1), 0);
}

TEST(SpatialLightSelector, HasSixtyFourVoxelsOnTheLongestAxis) {
  const Lights lights;
  EXPECT_EQ(SpatialLightSelector(lights.all(), kBox).resolution(), (Point3i{64, 64, 64}));
  EXPECT_EQ(SpatialLightSelector(lights.all(), {{0, 0, 0}, {10, 5, 0.01f}}).resolution(),
            (Point3i{64, 32, 1}));
  EXPECT_EQ(SpatialLightSelector(lights.all(), {{0, 0, 3}, {1, 2, 3}}).resolution(), (Point3i{32, 64, 1}))
      << "a flat scene";
}

TEST(SpatialLightSelector, WorksForASceneThatIsAPoint) {
  const Lights lights;
  const SpatialLightSelector selector(lights.all(), {{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(selector.resolution(), (Point3i{1, 1, 1}));
  EXPECT_GT(selector.probability(Point3f{5, 5, 5}, 0), 0);
}

TEST(SpatialLightSelector, BoundsItsMemoryForManyLights) {
  const PointLight light(Transform(), {});
  const std::vector<const Illuminant*> lights(20000, &light);
  const SpatialLightSelector selector(lights, kBox);
  const Point3i r = selector.resolution();
  EXPECT_LE(std::int64_t{r.x} * r.y * r.z * 20000, std::int64_t{1} << 24);
  EXPECT_GE(r.x, 8) << "still a grid";
  EXPECT_NEAR(selector.probability(Point3f{1, 2, 3}, 19999), 1.0 / 20000, 1e-9);
}

}  // namespace
}  // namespace pbrtmedia
