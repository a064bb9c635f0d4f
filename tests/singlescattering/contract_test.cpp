// SPDX-License-Identifier: BSD-2-Clause
// What every way of sampling lights in media promises, checked over the list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "lights/point.h"
#include "media/grid_medium.h"
#include "media/homogeneous.h"
#include "singlescattering/explore.h"
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
        single.sample(*lit, {u, v}, {}, rng, counters, [&](const StretchSample& sample) {
          sum += single.radiance(*lit, sample, scatterPoint(fog.ray, sample.t, {}, {}, counters), Rgb(1),
                                 shadows, rng);
        });
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
  if (explores(sampling_)) return;  // the next test is theirs
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
    RenderCounters counters;
    for (int n = 0; n < 200; ++n) {
      const float u = rng.uniform(), v = rng.uniform();
      double t = 3 * rng.uniformDouble(), share = 0;
      const auto collisionsAt = [&](double at) {
        return CollisionDensity(lit->media, *selector, 0, at, Point3f(0, 0, static_cast<float>(at)));
      };
      single.sample(*lit, {u, v}, {}, rng, counters, [&](const StretchSample& sample) {
        t = sample.t;
        share = sample.pdf * weightOf(sampling_, sample, collisionsAt(t));
      });
      EXPECT_NEAR(share + double{single.collisionShare(*lit, 0, t, {0, 0, static_cast<float>(t)})}, 1, 1e-6)
          << sigma << ", t " << t;
    }
  }
}

TEST_P(SamplingContract, CountsEachDistanceOnceWhateverItsNeighboursExplored) {
  // The sum of what samples count, times a function of the distance, has this function's integral as its
  // mean: with transmittance, of a medium of layers, and explorers that are right, wrong, or none.
  if (!explores(sampling_)) return;
  SceneKit kit;
  GridMediumParams grid;
  grid.name = "layers";
  grid.sigmaA = Rgb(.1f, .2f, .4f);
  grid.sigmaS = Rgb(.9f, .5f, .2f);
  grid.grid.nx = grid.grid.ny = 1;
  grid.grid.nz = 6;
  grid.grid.density = {.2f, 2, .5f, 0, 3, 1};
  grid.grid.border = GridBorder::Clamp;
  grid.grid.p0 = {-1, -1, 0};
  grid.grid.p1 = {1, 1, 3};
  const Medium* layers = kit.builder.own(makeGridMedium(grid, Transform()));
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, 0}, {1, 1, 3}), .media = {layers, nullptr}});
  kit.pointLight({.2f, .1f, 1}, 2);
  kit.pointLight({0, -.5f, 2.5f}, 1);
  const auto scene = kit.finish();
  const MediumState state({layers, nullptr});
  const Ray ray = rayOf({0, 0, 0}, {0, 0, 1});
  const auto selector = uniformSelector(*scene);
  const SingleScattering single(scene->lights(), selector.get(), sampling_);
  const MediaStretch media(state, ray, 0, 3);
  const auto lit = single.lit(media);
  ASSERT_TRUE(lit);
  RenderCounters counters;
  EXPECT_EQ(single.collisionShare(*lit, 0, 1, {0, 0, 1}), 0);
  constexpr int kSteps = 30000;
  double depth[3] = {}, sums[3] = {};
  for (int i = 0; i < kSteps; ++i) {
    const double h = 3.0 / kSteps, t = (i + 0.5) * h;
    const MediaStretch::Coefficients at = media.coefficients(t, counters);
    for (std::size_t c = 0; c < 3; ++c) {
      sums[c] += std::exp(-depth[c] - double{at.sigmaT[c]} * h / 2) * t * h;
      depth[c] += double{at.sigmaT[c]} * h;
    }
  }
  std::vector<Explorer> right, wrong;
  explore(media, 16, .5, counters, right);
  for (const Explorer& e : right) wrong.push_back({e.t, Rgb(.5f, 1.2f, 0), 2});
  for (const std::vector<Explorer>& near : {right, wrong, {}}) {
    Rng rng(kSeed);
    RunningStats found[3][2];
    for (int n = 0; n < 60000; ++n) {
      double sum[3][2] = {};
      const float u = rng.uniform(), v = rng.uniform();
      single.sample(*lit, {u, v}, near, rng, counters, [&](const StretchSample& s) {
        for (std::size_t c = 0; c < 3; ++c)
          sum[c][s.light] += s.walked->weight * double{s.walked->through[c]} * s.t;
      });
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t l = 0; l < 2; ++l) found[c][l].add(sum[c][l]);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t l = 0; l < 2; ++l) {
        const ZTest test = zTest(found[c][l], sums[c], kSeed);
        EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "channel " << c << ", light " << l << ": " << test;
        EXPECT_GT(std::abs(zTest(found[c][l], 1.3 * sums[c], kSeed).z()), kMaxAbsZ) << "would notice 30 %";
      }
    }
  }
}

TEST_P(SamplingContract, LeavesEndlessStretchesToCollisionsIfItExplores) {
  if (!explores(sampling_)) return;
  const Fog fog(Rgb(.1f), Rgb(.2f), {0, 1, 1});
  const auto selector = uniformSelector(*fog.scene);
  const SingleScattering single(fog.scene->lights(), selector.get(), sampling_);
  const auto lit = single.lit(fog.stretch(kInfinity));
  ASSERT_TRUE(lit);
  Rng rng(kSeed);
  RenderCounters counters;
  single.sample(*lit, {.5f, .5f}, {}, rng, counters, [](const StretchSample&) { FAIL() << "sampled"; });
  EXPECT_EQ(single.collisionShare(*lit, 0, 2, {0, 0, 2}), 1);
}

TEST_P(SamplingContract, WalksNoFurtherThanLightComes) {
  if (!explores(sampling_)) return;
  const Fog fog(Rgb(10), Rgb(9990), {0, 1, 1});
  const auto selector = uniformSelector(*fog.scene);
  const SingleScattering single(fog.scene->lights(), selector.get(), sampling_);
  const auto lit = single.lit(fog.stretch(4));
  ASSERT_TRUE(lit);
  Rng rng(kSeed);
  RenderCounters counters;
  constexpr int kWalks = 1000;
  for (int n = 0; n < kWalks; ++n) {
    const float u = rng.uniform(), v = rng.uniform();
    single.sample(*lit, {u, v}, {}, rng, counters, [](const StretchSample&) {});
  }
  EXPECT_LT(counters.nullCollisions, 10u * kWalks) << "of an optical depth of 40000";
}

TEST_P(SamplingContract, LeavesOutWhatCannotScatter) {
  const Fog fog(Rgb(0), Rgb(0), {0, 1, 1});
  const SingleScattering single(fog.scene->lights(), nullptr, sampling_);
  EXPECT_FALSE(single.lit(fog.stretch(3)));
  const MediumState vacuum;
  EXPECT_FALSE(single.lit({vacuum, fog.ray, 0, 3}));
}

INSTANTIATE_TEST_SUITE_P(All, SamplingContract, testing::ValuesIn(alternativeNames<MediumLightSampling>()),
                         [](const auto& parameter) {
                           std::string name(parameter.param);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

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
    single.sample(*lit, {u, v}, {}, rng, counters, [&](const StretchSample& sample) {
      sums.add(single
                   .radiance(*lit, sample, scatterPoint(fog.ray, sample.t, {}, {}, counters), Rgb(1),
                             {*fog.scene, &topology, counters, counters.shadowRays}, rng)
                   .r);
    });
  }
  EXPECT_GT(std::abs(zTest(sums, truthOf(fog, 4, 2, 1.03 * 2.2), kSeed).z()), kMaxAbsZ);
  EXPECT_LT(std::abs(zTest(sums, truthOf(fog, 4, 2, 2.2), kSeed).z()), kMaxAbsZ);
}

}  // namespace
}  // namespace pbrtmedia
