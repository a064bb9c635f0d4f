// SPDX-License-Identifier: BSD-2-Clause
// What every way of sampling lights in media promises, checked over the list.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "lights/point.h"
#include "media/homogeneous.h"
#include "singlescattering/single_scattering.h"
#include "support/function_line.h"
#include "support/scene_kit.h"
#include "support/source_dir.h"
#include "world/visibility.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr std::uint64_t kSeed = 20261130;

/// A ray through fog without end in which a point light of intensity 2 shines.
struct Fog {
  explicit Fog(Rgb sigmaA, Rgb sigmaS, Point3f position) : light(position) {
    kit.pointLight(position, 2);
    medium = kit.fog("fog", sigmaA, sigmaS);
    state = MediumState({medium, nullptr});
    scene = kit.finish();
  }
  MediaStretch stretch(double tMax) const { return {state, ray, 0, tMax}; }

  SceneKit kit;
  std::unique_ptr<Scene> scene;
  const Medium* medium = nullptr;
  MediumState state;
  Point3f light;
  Ray ray = rayOf({0, 0, 0}, {0, 0, 1});
};

class SamplingContract : public testing::TestWithParam<std::string_view> {
 protected:
  MediumLightSampling sampling_ = *findAlternative<MediumLightSampling>(GetParam());
};

TEST_P(SamplingContract, SaysWhatItIs) {
  const MediumLightSamplingTraits traits = traitsOf(sampling_);
  EXPECT_FALSE(traits.summary.empty());
  EXPECT_FALSE(traits.source.empty());
  EXPECT_FALSE(traits.useWhen.empty());
}

TEST_P(SamplingContract, HasItsSummaryInTheDocs) {
  std::ifstream file(sourceDir() / "docs" / "scene-language.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(page.empty());
  const std::string name = '`' + std::string(GetParam()) + '`';
  const std::string summary = " | " + std::string(traitsOf(sampling_).summary) + " |";
  EXPECT_TRUE(page.find("| " + name + summary) != page.npos ||
              page.find("| " + name + " (default)" + summary) != page.npos)
      << "| " << name << summary;
}

/// The integral over t of what the light scatters once toward the ray's start.
double truthOf(const Fog& fog, double tMax, double sigmaS, double sigmaT) {
  return simpson(
      [&](double t) {
        const double r2 = lengthSquared(Vec3d(0, 0, t) - Vec3d(fog.light));
        return sigmaS / (4 * M_PI) * std::exp(-sigmaT * (t + std::sqrt(r2))) * 2 / r2;
      },
      0, tMax);
}

TEST_P(SamplingContract, GivesTheExactSingleScatteringOfHomogeneousFog) {
  struct Case {
    Rgb sigmaA, sigmaS;
    Point3f light;
    double tMax;
  };
  // A light beside a thin stretch, one inside dense fog, one far away; and a stretch that ends before its
  // light.
  for (const Case& c : {Case{Rgb(.01f, .02f, 0), Rgb(.03f, .01f, .02f), {0, .1f, 2}, 5},
                        Case{Rgb(.2f, 0, .5f), Rgb(2, 1.5f, .3f), {.3f, 0, .5f}, 4},
                        Case{Rgb(.1f), Rgb(.5f), {0, 3, 6}, 2}, Case{Rgb(0), Rgb(1), {0, .5f, 2}, 1}}) {
    const Fog fog(c.sigmaA, c.sigmaS, c.light);
    const auto selector = uniformSelector(*fog.scene);
    const SingleScattering single(fog.scene->lights(), selector.get(), sampling_);
    const MediaTopology topology(*fog.scene);
    RenderCounters counters;
    const MediaWalk::Context shadows{*fog.scene, &topology, counters, counters.shadowRays};
    const MediaStretch stretch = fog.stretch(c.tMax);
    const auto lit = single.lit(stretch);
    EXPECT_EQ(lit.has_value(), traitsOf(sampling_).onStretches);
    Rng rng(kSeed);
    RunningStats sums[3];
    for (int n = 0; n < 60000; ++n) {
      Rgb sum;
      if (lit) {
        const float u = rng.uniform(), v = rng.uniform();
        if (const auto sample = single.sample(*lit, {u, v}))
          sum += single.radiance(*lit, *sample, scatterPoint(fog.ray, sample->t, {}, {}, counters), Rgb(1),
                                 shadows, rng);
      }
      const MediumFlight flight = stretch.sampleFreeFlight(Rgb(1), rng, counters);
      if (flight.collided) {
        const Point3f p(0, 0, static_cast<float>(flight.t));
        const LightSample light = fog.scene->lights()[0]->sample(p, {});
        const float share = lit ? single.collisionShare(*lit, 0, flight.t, p) : 1;
        MediumState state = fog.state;
        if (share > 0) {
          sum += flight.weight * light.radiance * (share * flight.phase->evaluate(-fog.ray.d, light.wi)) *
                 shadowTransmittance(shadows, shadowRayTo(*fog.scene, 0, light, p, 0, {}), state, rng);
        }
      }
      for (std::size_t i = 0; i < 3; ++i) sums[i].add(sum[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double truth = truthOf(fog, c.tMax, c.sigmaS[i], c.sigmaA[i] + c.sigmaS[i]);
      const auto test = zTest(sums[i], truth, kSeed);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "channel " << i << ": " << test;
    }
  }
}

TEST_P(SamplingContract, DividesTheWorkWithCollisionsExactly) {
  // Where a stretch takes a sample, its share of it and that of a collision there are one.
  for (const float sigma : {.01f, .3f, 5.f}) {
    const Fog fog(Rgb{sigma}, Rgb{sigma}, {0, .2f, 1});
    const auto selector = uniformSelector(*fog.scene);
    const SingleScattering single(fog.scene->lights(), selector.get(), sampling_);
    const auto lit = single.lit(fog.stretch(3));
    if (!lit) {
      EXPECT_FALSE(traitsOf(sampling_).onStretches);
      continue;
    }
    Rng rng(kSeed);
    for (int n = 0; n < 200; ++n) {
      const float u = rng.uniform(), v = rng.uniform();
      const auto sample = single.sample(*lit, {u, v});
      const double t = sample ? sample->t : 3 * rng.uniformDouble();
      const Point3f p(0, 0, static_cast<float>(t));
      const CollisionDensity collisions(lit->media, *selector, 0, t, p);
      const double share =
          sample ? sample->pdf *
                       std::visit([&](const auto& s) { return s.weight(*sample, collisions); }, sampling_)
                 : 0;
      EXPECT_NEAR(share + double{single.collisionShare(*lit, 0, t, p)}, 1, 1e-6) << sigma << ", t " << t;
    }
  }
}

TEST_P(SamplingContract, LeavesOutWhatCannotScatter) {
  const Fog fog(Rgb(0), Rgb(0), {0, 1, 1});
  const SingleScattering single(fog.scene->lights(), nullptr, sampling_);
  EXPECT_FALSE(single.lit(fog.stretch(3)));
  const MediumState vacuum;
  EXPECT_FALSE(single.lit({vacuum, fog.ray, 0, 3}));
}

INSTANTIATE_TEST_SUITE_P(All, SamplingContract, testing::ValuesIn(alternativeNames<MediumLightSampling>()),
                         [](const auto& parameter) { return std::string(parameter.param); });

/// The contract can fail: an extinction that is three percent off is noticed.
TEST(SamplingContractItself, NoticesAnExtinctionThatIsThreePercentOff) {
  const Fog fog(Rgb(.2f), Rgb(2), {.3f, 0, .5f});
  const auto selector = uniformSelector(*fog.scene);
  const SingleScattering single(fog.scene->lights(), selector.get(), EquiangularSampling{});
  const MediaTopology topology(*fog.scene);
  RenderCounters counters;
  const auto lit = single.lit(fog.stretch(4));
  ASSERT_TRUE(lit);
  Rng rng(kSeed);
  RunningStats sums;
  for (int n = 0; n < 60000; ++n) {
    const float u = rng.uniform(), v = rng.uniform();
    const auto sample = single.sample(*lit, {u, v});
    ASSERT_TRUE(sample);
    sums.add(single
                 .radiance(*lit, *sample, scatterPoint(fog.ray, sample->t, {}, {}, counters), Rgb(1),
                           {*fog.scene, &topology, counters, counters.shadowRays}, rng)
                 .r);
  }
  EXPECT_GT(std::abs(zTest(sums, truthOf(fog, 4, 2, 1.03 * 2.2), kSeed).z()), kMaxAbsZ);
  EXPECT_LT(std::abs(zTest(sums, truthOf(fog, 4, 2, 2.2), kSeed).z()), kMaxAbsZ);
}

}  // namespace
}  // namespace pbrtmedia
