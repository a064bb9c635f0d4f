// SPDX-License-Identifier: BSD-2-Clause
// No path leaves a closed boundary believing to be inside.
#include <gtest/gtest.h>

#include "base/warp.h"
#include "support/scene_kit.h"
#include "world/media_topology.h"

namespace pbrtmedia {
namespace {

using namespace test;
using Mode = OverlapRule::Mode;

struct LeakCase {
  const char* name;
  Point3f centre;
  bool isSphere;
  float size;  ///< radius or half-width

  /// How far outside a point is, negative inside, as a share of the largest coordinate.
  double outside(Vec3d p) const {
    const Vec3d d = abs(p - Vec3d(centre));
    const double beyond = (isSphere ? length(d) : maxComponent(d)) - static_cast<double>(size);
    return beyond / (static_cast<double>(maxComponent(abs(centre))) + static_cast<double>(size));
  }
};

/// Pure scattering that notices segments which lie outside its boundary.
class WatchedMedium final : public Medium {
 public:
  explicit WatchedMedium(const LeakCase& c)
      : Medium("watched", {}),
        case_(c),
        fog_({.name = "fog",
              .sigmaA = Rgb(0),
              .sigmaS = Rgb(2 / c.size),
              .phase = {PhaseLobe{}},
              .overlap = {}}) {}
  std::string_view typeName() const override { return "watched"; }
  Rgb transmittance(const Segment& s, PixelStream random, RenderCounters& counters) const override {
    watch(s);
    return fog_.transmittance(s, random, counters);
  }
  Rgb sigmaT() const override { return fog_.sigmaT(); }
  FreeFlight sampleFreeFlight(const Segment& s, Rgb throughput, PixelStream random,
                              RenderCounters& counters) const override {
    watch(s);
    return fog_.sampleFreeFlight(s, throughput, random, counters);
  }
  ScatteringProposal proposeScattering(const Segment& s, Rgb throughput, PixelStream random,
                                       RenderCounters& counters) const override {
    watch(s);
    return fog_.proposeScattering(s, throughput, random, counters);
  }
  const PhaseFunction& phase() const override { return fog_.phase(); }
  MediumPoint at(Point3f p, RenderCounters& counters) const override { return fog_.at(p, counters); }
  FlightControl flightControl(const Segment& s) const override { return fog_.flightControl(s); }
  Bounds3f bounds() const override { return fog_.bounds(); }
  std::string describe() const override { return "watched"; }
  mutable std::uint64_t segments = 0, leaks = 0;

 private:
  void watch(const Segment& s) const {
    ++segments;
    const double middle = 0.5 * (s.tMin + s.tMax);
    const Vec3d p = Vec3d(s.o) + middle * Vec3d(s.d);
    if (!std::isfinite(s.tMax) || case_.outside(p) > 2e-6) ++leaks;
  }
  LeakCase case_;
  HomogeneousMedium fog_;
};

class ClosedBoundary : public testing::TestWithParam<LeakCase> {};

TEST_P(ClosedBoundary, KeepsRandomWalksInside) {
  const LeakCase& c = GetParam();
  SceneKit kit;
  const WatchedMedium* fog = kit.builder.own(std::make_unique<WatchedMedium>(c));
  const Vector3f r(c.size, c.size, c.size);
  const Shape* shape = c.isSphere ? kit.sphere(c.centre, c.size) : kit.box(c.centre - r, c.centre + r);
  kit.builder.addPrimitive({.shape = shape, .media = {fog, nullptr}});
  kit.sky(1);
  const auto scene = kit.finish();
  ASSERT_TRUE(MediaTopology(*scene).isConfined(fog));
  const auto integrator = makeVolPath(*scene, {.maxDepth = 1 << 20});
  Rng rng(5);
  RenderCounters counters;
  RandomSampler sampler({.pixelSamples = 1, .seed = 3});
  RunningStats radiance;
  constexpr int kWalks = 200000;  // a million over all cases
  for (int i = 0; i < kWalks; ++i) {
    const Vector3f d = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const Vector3f aim = 0.9f * c.size * sampleUniformSphere({rng.uniform(), rng.uniform()});
    sampler.start({0, 0}, i);
    SampleContext context{sampler, rng, counters};
    const RayDifferential ray{rayOf(c.centre + aim + 4 * c.size * d, -d)};
    radiance.add(integrator->radiance(ray, context).r);
  }
  const ZTest white = zTest(radiance, 1);
  EXPECT_LT(std::abs(white.z()), kMaxAbsZ) << white;
  EXPECT_EQ(fog->leaks, 0u) << "of " << fog->segments << " segments";
  EXPECT_GT(counters.mediumScatterings, static_cast<std::uint64_t>(kWalks));
  EXPECT_EQ(counters.mediumMismatches, 0u);
  RecordProperty("repairs", std::to_string(counters.boundaryRepairs));
}

TEST(WatchedMedium, NoticesLeaks) {  // negative control
  const LeakCase c{"UnitBox", {0, 0, 0}, false, 1};
  const WatchedMedium medium(c);
  Rng rng(1);
  RenderCounters counters;
  medium.transmittance({{0, 0, 0}, {0, 0, 1}, 0, 1}, rng, counters);
  EXPECT_EQ(medium.leaks, 0u);
  medium.transmittance({{0, 0, 0}, {0, 0, 1}, 1, 1.00002}, rng, counters);
  medium.transmittance({{0, 0, 0}, {0, 0, 1}, 0, kInfinity}, rng, counters);
  EXPECT_EQ(medium.leaks, 2u);
}

INSTANTIATE_TEST_SUITE_P(Boxes, ClosedBoundary,
                         testing::Values(LeakCase{"UnitBox", {0, 0, 0}, false, 1},
                                         LeakCase{"BoxFarAway", {1000, -2000, 500}, false, 1},
                                         LeakCase{"TinyBoxAwayFromOrigin", {1, 1, 1}, false, 1e-3f},
                                         LeakCase{"Sphere", {0, 0, 0}, true, 1},
                                         LeakCase{"SphereFarAway", {1000, -2000, 500}, true, 1}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(ClosedBoundaryEscape, IsPutRight) {
  // The state a rounding error would leave behind: outside, believing to be inside.
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const Medium* smoke = kit.fog("smoke", Rgb(1), Rgb(0), {Mode::Add});
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.box({-2, -2, -2}, {2, 2, 2}), .media = {smoke, nullptr}});
  const auto scene = kit.finish();
  const MediaTopology media(*scene);
  MediumState state(PlacedMedium{fog});
  state.enter({smoke});
  RenderCounters counters;
  media.escape(state, counters);
  EXPECT_TRUE(state.isVacuum());
  EXPECT_EQ(counters.boundaryRepairs, 1u);
  media.escape(state, counters);
  EXPECT_EQ(counters.boundaryRepairs, 1u);
}

}  // namespace
}  // namespace pbrtmedia
