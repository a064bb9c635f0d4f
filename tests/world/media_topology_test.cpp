// SPDX-License-Identifier: BSD-2-Clause
#include "world/media_topology.h"

#include <gtest/gtest.h>

#include "media/grid_medium.h"
#include "support/scene_kit.h"
#include "world/line_walk.h"
#include "world/visibility.h"

namespace pbrtmedia {
namespace {

using Mode = OverlapRule::Mode;
using test::kMaxAbsZ;
using test::rayOf;
using test::RunningStats;
using test::SceneKit;

/// Transmittance of the whole line, starting in vacuum.
Rgb throughScene(const Scene& scene, const Ray& ray, RenderCounters& counters, MismatchLog* log = nullptr) {
  const MediaTopology media(scene);
  Rng rng(1);
  MediumState state;
  return shadowTransmittance({scene, &media, counters, counters.shadowRays, log}, {ray, {}}, state, rng);
}

/// Two boxes along z: "a" over [0, 2], "b" over [1, 3]; sigma_t 1 and 3.
struct Overlap {
  explicit Overlap(OverlapRule ruleA, OverlapRule ruleB) {
    const Medium* a = kit.fog("a", Rgb(1), Rgb(0), ruleA);
    const Medium* b = kit.fog("b", Rgb(3), Rgb(0), ruleB);
    kit.builder.addPrimitive({.shape = kit.box({-1, -1, 0}, {1, 1, 2}), .media = {a, nullptr}});
    kit.builder.addPrimitive({.shape = kit.box({-1, -1, 1}, {1, 1, 3}), .media = {b, nullptr}});
    scene = kit.finish();
  }
  double opticalDepth(bool forward) {
    const Ray ray = forward ? rayOf({0.3f, 0.2f, -1}, {0, 0, 1}) : rayOf({0.3f, 0.2f, 4}, {0, 0, -1});
    return -std::log(throughScene(*scene, ray, counters).r);
  }
  SceneKit kit;
  std::unique_ptr<Scene> scene;
  RenderCounters counters;
};

TEST(MediaTopology, AddsOverlappingMediaFromBothEnds) {
  Overlap scene({Mode::Add}, {Mode::Add});
  EXPECT_NEAR(scene.opticalDepth(true), 1 * 2 + 3 * 2, 1e-5);
  EXPECT_NEAR(scene.opticalDepth(false), 1 * 2 + 3 * 2, 1e-5);
  EXPECT_EQ(scene.counters.mediumMismatches, 0u);
}

TEST(MediaTopology, LetsTheHigherPriorityHideTheLowerFromBothEnds) {
  Overlap aWins({Mode::Priority, 2}, {Mode::Priority, 1});
  EXPECT_NEAR(aWins.opticalDepth(true), 1 * 2 + 3 * 1, 1e-5);
  EXPECT_NEAR(aWins.opticalDepth(false), 1 * 2 + 3 * 1, 1e-5);
  Overlap bWins({Mode::Priority, 1}, {Mode::Priority, 2});
  EXPECT_NEAR(bWins.opticalDepth(true), 1 * 1 + 3 * 2, 1e-5);
  EXPECT_NEAR(bWins.opticalDepth(false), 1 * 1 + 3 * 2, 1e-5);
}

TEST(MediaTopology, LetsTheLastBoundaryWinAsPbrtDoesAndCountsTheContradictions) {
  Overlap scene({Mode::Boundary}, {Mode::Boundary});
  // a over [0, 1], b over [1, 2]; leaving a ends everything.
  EXPECT_NEAR(scene.opticalDepth(true), 1 * 1 + 3 * 1, 1e-5);
  EXPECT_EQ(scene.counters.mediumMismatches, 3u);  // entering b, leaving a, leaving b
}

TEST(MediaTopology, NotesMismatchesWithNamesAndPlace) {
  Overlap scene({Mode::Boundary}, {Mode::Boundary});
  MismatchLog log{.pixel = {3, 4}, .sample = 5, .capacity = 2, .entries = {}};
  throughScene(*scene.scene, rayOf({0.3f, 0.2f, -1}, {0, 0, 1}), scene.counters, &log);
  ASSERT_EQ(log.entries.size(), 2u);
  const std::string text = log.entries[0].toString();
  EXPECT_NE(text.find("pixel 3 4, sample 5"), std::string::npos) << text;
  EXPECT_NE(text.find("vacuum"), std::string::npos) << text;
  EXPECT_NE(text.find("\"a\""), std::string::npos) << text;
}

/// Fog "a" in a box, seen from within it by a camera that was told to be in "b".
TEST(MediaTopology, TellsTheStateOfAnyPointFromTheCameras) {
  SceneKit kit;
  const Medium* a = kit.fog("a", Rgb(1), Rgb(2));
  const Medium* b = kit.fog("b", Rgb(3), Rgb(4), {Mode::Add});
  kit.builder.addPrimitive(
      {.shape = kit.box({-1, -1, 0}, {1, 1, 2}), .material = kit.black(), .media = {a, nullptr}});
  kit.builder.addPrimitive({.shape = kit.box({-2, -2, 1}, {2, 2, 3}), .media = {b, nullptr}});
  const auto scene = kit.finish();
  RenderCounters counters;
  const MediaTopology found(*scene, CameraMedium(*scene, {.1f, .2f, .5f}, 0));
  EXPECT_EQ(found.stateAt({.1f, .2f, .5f}, 0, counters).describe(), R"("a")");
  EXPECT_EQ(found.stateAt({.3f, .1f, 1.5f}, 0, counters).describe(), R"("a" + "b")");
  EXPECT_EQ(found.stateAt({.3f, .1f, 2.5f}, 0, counters).describe(), R"("b")");
  EXPECT_EQ(found.stateAt({.3f, .1f, 9}, 0, counters).describe(), "vacuum");
  const MediaTopology given(*scene, CameraMedium(*scene, {.3f, .1f, 9}, 0, a));
  EXPECT_EQ(given.stateOf(rayOf({.3f, .1f, 10}, {0, 0, 1}), counters).describe(), R"("a")")
      << "wherever it starts";
  EXPECT_EQ(given.stateAt({.3f, .1f, 10}, 0, counters).describe(), R"("a")");
  EXPECT_EQ(given.stateAt({.3f, .1f, 2.5f}, 0, counters).describe(), R"("a" + "b")");
}

TEST(MediaTopology, KeepsFogUnderAnAddedMediumThatNamesNoOther) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const Medium* smoke = kit.fog("smoke", Rgb(3), Rgb(0), {Mode::Add});
  kit.builder.addPrimitive({.shape = kit.box({-9, -9, 0}, {9, 9, 4}), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, 1}, {1, 1, 2}), .media = {smoke, nullptr}});
  const auto scene = kit.finish();
  RenderCounters counters;
  EXPECT_NEAR(-std::log(throughScene(*scene, rayOf({0.3f, 0.2f, -1}, {0, 0, 1}), counters).r), 4 + 3, 1e-5);
  EXPECT_EQ(counters.mediumMismatches, 0u);
}

TEST(MediaTopology, CrossesCoincidentBoundariesExactly) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  for (int i = 0; i < 3; ++i) {
    const auto z = static_cast<float>(i);
    kit.builder.addPrimitive({.shape = kit.box({-5, -5, z}, {5, 5, z + 1}), .media = {fog, nullptr}});
  }
  const auto scene = kit.finish();
  RenderCounters counters;
  const Ray ray = rayOf({0.3f, 0.2f, -1}, {0, 0, 1});
  EXPECT_NEAR(-std::log(throughScene(*scene, ray, counters).r), 3, 1e-5);
  EXPECT_GT(throughScene(*scene, rayOf({0.3f, 9, -1}, {0, 0, 1}), counters).r, 0.999f);  // negative control
  Rng rng(7);
  for (int i = 0; i < 2000; ++i) {
    const Point3f o(rng.uniform() - 0.5f, rng.uniform() - 0.5f, -1 - rng.uniform());
    const Vector3f d(0.3f * rng.uniform(), 0.3f * rng.uniform(), 1);
    const double depth = 3.0 * length(Vec3d(d));
    EXPECT_NEAR(-std::log(throughScene(*scene, rayOf(o, d), counters).r), depth, 2e-5) << o << ' ' << d;
    const Point3f above(o.x, o.y, 3 - o.z);
    EXPECT_NEAR(-std::log(throughScene(*scene, rayOf(above, {d.x, d.y, -1}), counters).r), depth, 2e-5)
        << o << ' ' << d;
  }
  EXPECT_EQ(counters.mediumMismatches, 0u);
}

TEST(MediaTopology, GivesTheChordThroughEdgesAndCorners) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fog, nullptr}});
  const auto scene = kit.finish();
  RenderCounters counters;
  const Bounds3d box{{-1, -1, -1}, {1, 1, 1}};
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      const Point3f target(static_cast<float>(x) / 4, static_cast<float>(y) / 4, 1);
      for (const Point3f o :
           {Point3f(0.5f, 0.25f, 7), Point3f(3, 3, 3), Point3f(-5, 0, 4), Point3f(0, 0, 9)}) {
        const Ray ray = rayOf(o, target - o);
        // A ray along a face may count as inside or outside.
        const double depth = -std::log(throughScene(*scene, ray, counters).r);
        double least = 9, most = 0;
        for (const double grow : {-1e-5, 1e-5}) {
          Bounds3d b = box;
          b.min = b.min - Vec3d(grow, grow, grow);
          b.max = b.max + Vec3d(grow, grow, grow);
          const auto span = clipToBox(b, Vec3d(ray.o), Vec3d(ray.d), 0.0, 1e9);
          const double chord = span ? span->tMax - span->tMin : 0;
          least = std::min(least, chord);
          most = std::max(most, chord);
        }
        EXPECT_GT(depth, least - 1e-4) << target << " from " << o;
        EXPECT_LT(depth, most + 1e-4) << target << " from " << o;
      }
    }
  }
}

TEST(MediaTopology, LetsAnInterfaceWithoutMaterialBlockNothingAndAMaterialEverything) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(1, 1)});
  kit.builder.addPrimitive({.shape = kit.square(2, 0.5f), .material = kit.black()});
  const auto scene = kit.finish();
  RenderCounters counters;
  EXPECT_EQ(throughScene(*scene, rayOf({0.7f, 0.2f, 0}, {0, 0, 1}), counters), Rgb(1));
  EXPECT_EQ(throughScene(*scene, rayOf({0.3f, 0.2f, 0}, {0, 0, 1}), counters), Rgb(0));
}

TEST(MediaTopology, KnowsWhichMediaAreConfined) {
  SceneKit kit;
  const Medium* ball = kit.fog("ball", Rgb(1), Rgb(0));
  const Medium* outer = kit.fog("outer", Rgb(1), Rgb(0));
  const Medium* sheet = kit.fog("sheet", Rgb(1), Rgb(0));
  const Medium* cavity = kit.fog("cavity", Rgb(1), Rgb(0));
  const Medium* patched = kit.fog("patched", Rgb(1), Rgb(0));
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {ball, outer}});
  kit.builder.addPrimitive({.shape = kit.square(3, 1), .media = {sheet, nullptr}});
  kit.builder.addPrimitive({.shape = kit.sphere({9, 0, 0}, 1, /*reverse=*/true), .media = {cavity, nullptr}});
  // A box of two open parts: a cup and its lid.
  kit.builder.addPrimitive(
      {.shape = kit.quad({20, 0, 1}, {21, 0, 1}, {21, 1, 1}, {20, 1, 1}), .media = {patched, nullptr}});
  for (const auto& [a, b, c, d] :
       std::vector<std::array<Point3f, 4>>{{{{20, 0, 0}, {20, 1, 0}, {21, 1, 0}, {21, 0, 0}}},
                                           {{{20, 0, 0}, {21, 0, 0}, {21, 0, 1}, {20, 0, 1}}},
                                           {{{21, 0, 0}, {21, 1, 0}, {21, 1, 1}, {21, 0, 1}}},
                                           {{{21, 1, 0}, {20, 1, 0}, {20, 1, 1}, {21, 1, 1}}},
                                           {{{20, 1, 0}, {20, 0, 0}, {20, 0, 1}, {20, 1, 1}}}}) {
    kit.builder.addPrimitive({.shape = kit.quad(a, b, c, d), .media = {patched, nullptr}});
  }
  const auto scene = kit.finish();
  const MediaTopology media(*scene);
  EXPECT_TRUE(media.isConfined(ball));
  EXPECT_FALSE(media.isConfined(outer));
  EXPECT_FALSE(media.isConfined(sheet));
  EXPECT_FALSE(media.isConfined(cavity));
  EXPECT_TRUE(media.isConfined(patched));
  EXPECT_FALSE(MediaTopology(*scene, CameraMedium(*scene, test::kFarAway, 0, ball)).isConfined(ball));
}

TEST(MediaTopology, MovesScatterPointsBackToTheirSideOfTheBoundary) {
  const Ray ray = rayOf({0.25f, 0.5f, 0}, {0.3f, 0.2f, 1});
  RenderCounters counters;
  for (const float z : {0.7f, 1.0f, 3.14159f, 100.0f}) {
    const double t = static_cast<double>(z) / ray.d.z;
    const Point3f hit = ray.at(static_cast<float>(t));
    const BoundaryPlane end{true, Vec3d(hit.x, hit.y, z), {0, 0, -1}};
    const Point3f p = scatterPoint(ray, t, {}, end, counters).p;
    EXPECT_LT(p.z, z);
    EXPECT_GT(p.z, z * (1 - 1e-5f));
    const Point3f inner = scatterPoint(ray, t / 2, {}, end, counters).p;
    EXPECT_EQ(inner, (Segment{ray.o, ray.d, 0, t}.at(t / 2)));  // nothing to repair there
  }
  EXPECT_GT(counters.boundaryRepairs, 0u);
}

// ---- Free flights through several media -----------------------------------------------------------------

/// Through "a" and "b" at once over a unit length: what passes, and what collides at t, must be as in one
/// medium with the sums of the coefficients.
void expectFlightsOfSum(const Medium& a, const Medium& b, Rgb sigmaT, Rgb sigmaS, std::uint64_t seed) {
  MediumState state;
  state.enter({&a});
  state.enter({&b});
  const Ray ray = rayOf({0, 0, 0}, {0, 0, 1});
  constexpr int kFlights = 1 << 18, kBins = 4;
  std::array<std::array<RunningStats, 3>, kBins + 1> sums;  // collisions by quarter of the way; passing
  Rng rng(seed);
  RenderCounters counters;
  for (int i = 0; i < kFlights; ++i) {
    const MediumFlight f = MediaStretch(state, ray, 0, 1).sampleFreeFlight(Rgb(1), rng, counters);
    const int bin = f.collided ? std::min(static_cast<int>(f.t * kBins), kBins - 1) : kBins;
    for (int k = 0; k <= kBins; ++k) {
      for (std::size_t c = 0; c < 3; ++c)
        sums[static_cast<std::size_t>(k)][c].add(k == bin ? f.weight[c] : 0);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double s = sigmaT[c];
    for (int k = 0; k < kBins; ++k) {
      const double t0 = k / double{kBins}, t1 = (k + 1) / double{kBins};
      const auto test = zTest(sums[static_cast<std::size_t>(k)][c],
                              sigmaS[c] / s * (std::exp(-s * t0) - std::exp(-s * t1)), seed);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "quarter " << k << ", channel " << c << ": " << test;
    }
    const auto passed = zTest(sums[kBins][c], std::exp(-s), seed);
    EXPECT_LT(std::abs(passed.z()), kMaxAbsZ) << "passing, channel " << c << ": " << passed;
  }
}

TEST(MediaFlight, OfTwoHomogeneousMediaIsThatOfTheirSum) {
  SceneKit kit;
  expectFlightsOfSum(*kit.fog("a", Rgb(0.5f), Rgb(1)), *kit.fog("b", Rgb(0.2f), Rgb(0.6f)), Rgb(2.3f),
                     Rgb(1.6f), 11);
}

TEST(MediaFlight, OfChromaticMediaIsThatOfTheirSum) {
  SceneKit kit;
  expectFlightsOfSum(*kit.fog("a", Rgb(0.1f, 0.5f, 1), Rgb(1, 0.4f, 0.2f)),
                     *kit.fog("b", Rgb(0.4f, 0, 0.1f), Rgb(0.1f, 1, 2)), Rgb(1.6f, 1.9f, 3.3f),
                     Rgb(1.1f, 1.4f, 2.2f), 12);
}

TEST(MediaFlight, ThroughAGridAndAHomogeneousMediumIsThatOfTheirSum) {
  SceneKit kit;
  GridMediumParams grid;
  grid.name = "grid";
  grid.sigmaA = Rgb(0.3f, 0.1f, 0.5f);
  grid.sigmaS = Rgb(0.7f, 1.2f, 0.1f);
  grid.grid.nx = grid.grid.ny = grid.grid.nz = 4;
  grid.grid.density.assign(64, 1);
  grid.grid.p0 = {-2, -2, -2};
  grid.grid.p1 = {2, 2, 2};
  grid.grid.border = GridBorder::Clamp;
  const auto medium = makeGridMedium(grid, Transform());
  expectFlightsOfSum(*medium, *kit.fog("b", Rgb(0.2f), Rgb(0.6f)), Rgb(1.8f, 2.1f, 1.4f),
                     Rgb(1.3f, 1.8f, 0.7f), 13);
}

}  // namespace
}  // namespace pbrtmedia
