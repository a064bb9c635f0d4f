// SPDX-License-Identifier: BSD-2-Clause
#include "fields/learned_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "fields/constant_field.h"
#include "fields/explore_bounds.h"
#include "fields/field_line.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20241126;

SuperVoxelLattice lattice(std::int64_t n) {
  return {LatticeShape{{n, n, n}}, {1, 1, 1}, {{0, 0, 0}, Vec3d(1, 1, 1) * static_cast<double>(n)}};
}

float density(Vec3d p) { return static_cast<float>(p.x * p.y + .1 * p.z); }

TEST(LearnedBounds, CutToTheBoundInForceAndRaiseItOnlyWhenPublished) {
  LearnedBounds bounds(lattice(2), {.initial = .5f, .epsilon = .25f});
  EXPECT_EQ(bounds.bounded({.5, .5, .5}, .25f), .25f);
  EXPECT_EQ(bounds.bounded({.5, .5, .5}, 2.0f), .5f);
  EXPECT_EQ(bounds.bounded({.5, .5, .5}, 2.0f), .5f) << "a proposal has no effect within the pass";
  EXPECT_EQ(bounds.inForce().at(0, 0, 0).upper, .5f);
  bounds.publish();
  EXPECT_EQ(bounds.inForce().at(0, 0, 0).upper, 2.25f);
  EXPECT_EQ(bounds.inForce().at(0, 0, 0).lower, 0.0f) << "the least density seen minus epsilon";
  EXPECT_EQ(bounds.inForce().at(1, 0, 0).upper, .5f);
  EXPECT_EQ(bounds.inForce().maximum(), 2.25f);
  EXPECT_EQ(bounds.progress().cut, 2u);
  EXPECT_EQ(bounds.bounded({.5, .5, .5}, 2.0f), 2.0f);
  EXPECT_EQ(bounds.progress().passes, 1u);
  EXPECT_EQ(bounds.progress().raised, 1u);
  EXPECT_EQ(bounds.progress().visited, 1u);
  EXPECT_EQ(bounds.progress().cells, 8u);
}

TEST(LearnedBounds, ExploreUntilAPassRaisesNothing) {
  LearnedBounds bounds(lattice(2), {.initial = .5f, .epsilon = .25f});
  EXPECT_TRUE(bounds.isExploring());
  bounds.bounded({.5, .5, .5}, 2);
  bounds.publish();
  EXPECT_TRUE(bounds.isExploring());
  bounds.bounded({.5, .5, .5}, 2);
  bounds.publish();
  EXPECT_FALSE(bounds.isExploring());
  bounds.bounded({1.5, .5, .5}, 2);
  bounds.publish();
  EXPECT_TRUE(bounds.isExploring()) << "a new find";
}

TEST(LearnedBounds, NeverFallAndBoundWhatWasSeen) {
  LearnedBounds bounds(lattice(4), {.initial = .01f, .epsilon = .01f});
  Rng rng(kSeed);
  for (int pass = 0; pass < 20; ++pass) {
    const std::vector<float> before = bounds.save();
    for (int n = 0; n < 500; ++n) {
      const Vec3d p = Vec3d(rng.uniformDouble(), rng.uniformDouble(), rng.uniformDouble()) * 4;
      const float d = density(p);
      ASSERT_LE(bounds.bounded(p, d), bounds.inForce().upperOf(bounds.inForce().cellAt(p)));
    }
    bounds.publish();
    const std::vector<float> after = bounds.save();
    for (std::size_t i = 0; i < after.size(); i += 2) ASSERT_GE(after[i], before[i]);
  }
  int violations = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3d p = Vec3d(rng.uniformDouble(), rng.uniformDouble(), rng.uniformDouble()) * 4;
    violations += density(p) > bounds.inForce().upperOf(bounds.inForce().cellAt(p));
  }
  EXPECT_LT(violations, 600) << "after 10000 lookups in 64 cells most of the volume is bounded";
}

TEST(LearnedBounds, DependOnNeitherThreadsNorOrder) {
  std::vector<std::vector<float>> results;
  for (const int threads : {1, 4}) {
    LearnedBounds bounds(lattice(4), {});
    for (int pass = 0; pass < 3; ++pass) {
      std::vector<std::thread> crew;
      for (int t = 0; t < threads; ++t) {
        crew.emplace_back([&, t] {
          for (int n = t; n < 4000; n += threads) {
            Rng rng(kSeed + static_cast<std::uint64_t>(pass * 4000 + n));
            const Vec3d p = Vec3d(rng.uniformDouble(), rng.uniformDouble(), rng.uniformDouble()) * 4;
            bounds.bounded(p, density(p));
          }
        });
      }
      for (std::thread& thread : crew) thread.join();
      bounds.publish();
    }
    results.push_back(bounds.save());
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(LearnedBounds, TellTheShareOfProbedExtinctionThatTheyCutAway) {
  LearnedBounds bounds(lattice(1), {.initial = 1, .epsilon = .5f});
  const Vec3d p{.5, .5, .5};
  for (const float d : {.5f, 4.0f, 2.0f}) bounds.bounded(p, d);
  bounds.publish();
  EXPECT_EQ(bounds.progress().shortfall, 0) << "nothing was probed";

  LearnedBounds probed(lattice(1), {.initial = 1, .epsilon = .5f});
  probed.probe(p, .5f, 1);
  probed.probe(p, 0, 1);
  probed.probe(p, 4, 1);
  probed.probe(p, 2, .25);  // a shorter segment
  probed.publish();
  EXPECT_EQ(probed.progress().shortfall, (3 + .25 * 1) / (.5 + 4 + .25 * 2));
  EXPECT_EQ(probed.progress().cut, 2u);
  EXPECT_EQ(probed.inForce().maximum(), 4.5f) << "probes propose bounds";
  probed.probe(p, 4, 1);
  probed.publish();
  EXPECT_EQ(probed.progress().shortfall, 0);
  // Neither the densest probe nor the thinnest is all that counts.
  probed.probe(p, 1e30f, 1);
  for (int i = 0; i < 64; ++i) probed.probe(p, 1, 1);
  probed.publish();
  EXPECT_NEAR(probed.progress().shortfall, .5, 1e-6);
}

TEST(LearnedBounds, AreExploredToTheTopOfEveryCell) {
  // In each cell a hill of its own height, of a standard deviation of a fifth of the cell.
  const auto hills = [](Vec3d p) {
    const Vec3d cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    const Vec3d d = p - cell - Vec3d(.3, .6, .45);
    return static_cast<float>((1 + cell.x + 2 * cell.y) * std::exp(-lengthSquared(d) / .08));
  };
  LearnedBounds bounds(lattice(3), {.initial = .01f, .epsilon = .001f, .warmUpPasses = 4});
  ASSERT_EQ(bounds.warmUpPasses(), 4);
  const Exploration plan = planExploration(bounds.inForce().shape(), 4, 27 * 4 * 16);
  EXPECT_EQ(exploreBounds(bounds, plan, 0, 27, kSeed, hills), 27u * 4 * 16);
  EXPECT_EQ(bounds.inForce().maximum(), .01f) << "not before they are published";
  bounds.publish();
  EXPECT_EQ(bounds.warmUpPasses(), 0) << "once is enough";
  for (std::int64_t k = 0; k < 3; ++k) {
    for (std::int64_t j = 0; j < 3; ++j) {
      for (std::int64_t i = 0; i < 3; ++i) {
        const float top = static_cast<float>(1 + i + 2 * j);
        EXPECT_GT(bounds.inForce().at(i, j, k).upper, .9f * top);
        EXPECT_LE(bounds.inForce().at(i, j, k).upper, top + .002f);
      }
    }
  }
  // In parts, and in any order, it is the same; from another seed it is not.
  LearnedBounds parts(lattice(3), bounds.params()), other(lattice(3), bounds.params());
  exploreBounds(parts, plan, 20, 27, kSeed, hills);
  exploreBounds(parts, plan, 0, 11, kSeed, hills);
  exploreBounds(parts, plan, 11, 20, kSeed, hills);
  parts.publish();
  EXPECT_EQ(parts.save(), bounds.save());
  exploreBounds(other, plan, 0, 27, kSeed + 1, hills);
  other.publish();
  EXPECT_NE(other.save(), bounds.save());
  EXPECT_THROW(LearnedBounds(lattice(1), {.warmUpPasses = -1}), SceneError);
}

TEST(LearnedBounds, AreExploredInBlocksWhereEverySuperVoxelGetsTheExtremesOfItsBlock) {
  // The x of a look-up: blocks of 4 of the 6 x 6 x 6 super-voxels, the last ones of 2.
  LearnedBounds bounds(lattice(6), {.initial = .01f, .epsilon = .001f, .warmUpPasses = 4});
  const Exploration plan = planExploration(bounds.inForce().shape(), 4, 8 * 3 * 16);
  ASSERT_EQ(plan.blockEdge, 4);
  ASSERT_EQ(plan.passes, 3);
  const std::uint64_t lookups = exploreBounds(bounds, plan, 0, plan.blockCount(), kSeed,
                                              [](Vec3d p) { return static_cast<float>(p.x); });
  EXPECT_EQ(lookups, plan.lookups());
  bounds.publish();
  EXPECT_EQ(bounds.progress().visited, 216u);
  for (std::int64_t k = 0; k < 6; ++k) {
    for (std::int64_t i = 0; i < 6; ++i) {
      const SuperVoxel cell = bounds.inForce().at(i, 5 - k, k);
      const float from = i < 4 ? 0 : 4, to = i < 4 ? 4 : 6;
      EXPECT_GT(cell.upper, to - .1f * (to - from));
      EXPECT_LE(cell.upper, to + .002f);
      EXPECT_LT(cell.lower, from + .2f * (to - from));
      EXPECT_GE(cell.lower, std::max(0.0f, from - .002f));
    }
  }
  // Without look-ups nothing is explored.
  LearnedBounds none(lattice(6), bounds.params());
  const Exploration nothing = planExploration(none.inForce().shape(), 4, 15);
  EXPECT_EQ(exploreBounds(none, nothing, 0, nothing.blockCount(), kSeed, [](Vec3d) { return 1.0f; }), 0u);
  none.publish();
  EXPECT_EQ(none.inForce().maximum(), .01f);
  EXPECT_EQ(none.progress().visited, 0u);
}

TEST(LearnedBounds, LetDensitiesPassWithinTheSlack) {
  LearnedBounds bounds(lattice(1), {.initial = 1, .epsilon = .5f, .slack = .25f});
  EXPECT_EQ(bounds.bounded({.5, .5, .5}, 1.2f), 1.2f);
  EXPECT_EQ(bounds.bounded({.5, .5, .5}, 4.5f), 1.25f);
  bounds.publish();
  EXPECT_FLOAT_EQ(bounds.inForce().at(0, 0, 0).upper, 4);
}

TEST(LearnedBounds, StartWhereOthersStopped) {
  LearnedBounds first(lattice(2), {}), second(lattice(2), {}), other(lattice(3), {});
  first.bounded({.5, .5, .5}, 7);
  first.publish();
  ASSERT_TRUE(second.restore(first.save()));
  EXPECT_EQ(second.save(), first.save());
  second.publish();
  EXPECT_EQ(second.save(), first.save());
  EXPECT_FALSE(other.restore(first.save()));
  std::vector<float> bad = first.save();
  for (const float wrong : {-1.0f, 0.0f, std::numeric_limits<float>::quiet_NaN(), kInfinity}) {
    bad[2] = wrong;
    EXPECT_FALSE(second.restore(bad)) << wrong;
  }
  EXPECT_EQ(second.save(), first.save());
}

TEST(LearnedBounds, GoOnElsewhereAsIfNothingHadHappened) {
  const auto look = [](LearnedBounds& bounds, int pass) {
    Rng rng(kSeed + static_cast<std::uint64_t>(pass));
    for (int n = 0; n < 40; ++n) {
      const Vec3d p = Vec3d(rng.uniformDouble(), rng.uniformDouble(), rng.uniformDouble()) * 4;
      bounds.probe(p, density(p), 1);
    }
    bounds.publish();
  };
  LearnedBounds whole(lattice(4), {}), second(lattice(4), {}), cached(lattice(4), {});
  for (int pass = 0; pass < 3; ++pass) look(whole, pass);
  ASSERT_TRUE(second.fits(whole.state()));
  second.restore(whole.state());
  ASSERT_TRUE(cached.restore(whole.save()));
  EXPECT_EQ(second.isExploring(), whole.isExploring());
  EXPECT_EQ(second.isRestored(), whole.isRestored());
  EXPECT_EQ(second.warmUpPasses(), whole.warmUpPasses());
  EXPECT_EQ(second.progress().maximum, whole.progress().maximum);
  EXPECT_EQ(second.progress().shortfall, whole.progress().shortfall);
  for (int pass = 3; pass < 6; ++pass) {
    for (LearnedBounds* bounds : {&whole, &second, &cached}) look(*bounds, pass);
  }
  EXPECT_EQ(second.save(), whole.save());
  EXPECT_EQ(second.progress().passes, 6u);
  EXPECT_EQ(second.progress().raised, whole.progress().raised);
  EXPECT_EQ(second.progress().visited, whole.progress().visited);
  // Negative control: the bounds alone are not all there is to know.
  EXPECT_NE(cached.progress().passes, whole.progress().passes);
  EXPECT_TRUE(cached.isRestored());

  EXPECT_FALSE(LearnedBounds(lattice(3), {}).fits(whole.state()));
  LearnedBounds::State half = whole.state();
  half.least.pop_back();
  EXPECT_FALSE(second.fits(half));
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  using Numbers = std::vector<float> LearnedBounds::State::*;
  const std::vector<std::pair<Numbers, std::vector<float>>> wrong = {
      {&LearnedBounds::State::upper, {0, -1, kNaN, kInf}},
      {&LearnedBounds::State::most, {0, -1, kNaN, kInf}},
      {&LearnedBounds::State::lower, {-1, kNaN, kInf}},
      {&LearnedBounds::State::least, {-1, kNaN}}};
  for (const auto& [numbers, values] : wrong) {
    for (const float value : values) {
      LearnedBounds::State bad = whole.state();
      (bad.*numbers)[5] = value;
      EXPECT_FALSE(second.fits(bad)) << value;
    }
  }
  LearnedBounds::State unseen = whole.state();
  unseen.least[5] = kInf;
  EXPECT_TRUE(second.fits(unseen));
}

TEST(FieldBounds, CutTheDensityWhereTheyAreLearned) {
  const ConstantField field({.density = 3}, Transform());
  const FieldBounds bounds =
      FieldBounds::learned(field.superVoxels().lattice(), {.initial = .5f, .epsilon = .5f});
  EXPECT_FALSE(bounds.areProven());
  const Segment through{{-1, .5f, .5f}, {1, 0, 0}, 0, 10};
  const auto line = FieldLine<ConstantField>::clip(field, bounds, through);
  ASSERT_TRUE(line);
  EXPECT_FALSE(line->hasProvenBounds());
  EXPECT_EQ(line->density(.5), .5f);
  bounds.learned()->publish();
  EXPECT_EQ(line->density(.5), 3.0f);
  const std::vector<double> s{.1, .5, .9, .95, .99};
  std::vector<float> out(s.size());
  line->densities(s, out);
  EXPECT_EQ(out, std::vector<float>(5, 3.0f));
}

TEST(FieldBounds, CutNothingWhereTheyAreGiven) {
  const ConstantField field({.density = 3}, Transform());
  const FieldBounds bounds =
      FieldBounds::given(SuperVoxels(field.superVoxels().lattice(), SuperVoxel{.5f, 0, -1}));
  EXPECT_EQ(bounds.learned(), nullptr);
  EXPECT_EQ(bounds.inForce().maximum(), .5f);
  const auto line = FieldLine<ConstantField>::clip(field, bounds, {{-1, .5f, .5f}, {1, 0, 0}, 0, 10});
  ASSERT_TRUE(line);
  EXPECT_FALSE(line->hasProvenBounds());
  EXPECT_EQ(line->density(.5), 3.0f);
}

}  // namespace
}  // namespace pbrtmedia
