// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/learned_shares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "lighting/light_tree_selector.h"
#include "support/many_lights.h"

namespace pbrtmedia {
namespace {

const LearnedShares::Prior kPrior{{0.5, 0.5}, 0.1};

/// What light samples bring that choose either of two clusters with probability 1/2: `sends(p, cluster)`.
template <class Sends>
LightTrials trialsOf(int count, const Sends& sends) {
  LightTrials trials;
  Rng rng(8);
  const double importances[] = {0.5, 0.5};
  for (int i = 0; i < count; ++i) {
    const Point3f p{rng.uniform(), rng.uniform(), 0};
    const std::uint32_t cluster = rng.uniform() < 0.5f ? 0 : 1;
    const double x = 2 * sends(p, cluster);
    if (x > 0) trials.add({p, cluster, x * x * 0.5, i % 2 != 0}, importances);
  }
  return trials;
}

/// The probability of the first cluster at a point, importances being alike.
double firstAt(const LearnedShares& shares, Point3f p) {
  const std::span<const double> f = shares.at(p);
  return f.empty() ? 0.5 : 0.9 * f[0] / (f[0] + f[1]) + 0.05;
}

TEST(LearnedShares, KnowNothingWithoutTrials) {
  const LearnedShares shares = LearnedShares::learn({}, kPrior);
  EXPECT_TRUE(shares.at({1, 2, 3}).empty());
  EXPECT_EQ(shares.cellCount(), 0u);
}

TEST(LearnedShares, ComeToTheLeastNoise) {
  // Of clusters that always send 3 and 1, the probabilities with the least noise are 3/4 and 1/4.
  const LearnedShares shares = LearnedShares::learn(
      trialsOf(20000, [](Point3f, std::uint32_t c) { return c == 0 ? 3.0 : 1.0; }), kPrior);
  EXPECT_EQ(shares.cellCount(), 1u);
  EXPECT_NEAR(firstAt(shares, {0.5f, 0.5f, 0}), 0.75, 0.01);
  // Of one that sends 8 to a quarter of the points and one that sends 4 to all, that of the roots of the
  // second moments: 4 and 4. Means would say 2 to 4.
  Rng rng(3);
  const LearnedShares rare = LearnedShares::learn(
      trialsOf(40000,
               [&](Point3f, std::uint32_t c) { return c == 1                  ? 4.0
                                                      : rng.uniform() < 0.25f ? 8.0
                                                                              : 0.0; }),
      kPrior);
  EXPECT_NEAR(firstAt(rare, {0.5f, 0.5f, 0}), 0.5, 0.02);
}

TEST(LearnedShares, SplitSpaceWhereThatPaysAndNowhereElse) {
  const LearnedShares halves = LearnedShares::learn(
      trialsOf(8000, [](Point3f p, std::uint32_t c) { return (p.x < 0.4f) == (c == 0) ? 1.0 : 0.05; }),
      kPrior);
  EXPECT_GT(halves.cellCount(), 1u);
  EXPECT_GT(firstAt(halves, {0.1f, 0.5f, 0}), 0.85);
  EXPECT_LT(firstAt(halves, {0.9f, 0.5f, 0}), 0.15);
  // Noise that has nothing to do with the place, and importances that are right.
  Rng rng(4);
  const LearnedShares alike = LearnedShares::learn(
      trialsOf(8000, [&](Point3f, std::uint32_t) { return -std::log(1 - rng.uniform()); }), kPrior);
  EXPECT_EQ(alike.cellCount(), 1u);
  EXPECT_EQ(firstAt(alike, {0.5f, 0.5f, 0}), 0.5);
}

TEST(LearnedShares, ComeBackFromTheirState) {
  const LearnedShares shares = LearnedShares::learn(
      trialsOf(8000, [](Point3f p, std::uint32_t c) { return (p.x < 0.4f) == (c == 0) ? 1.0 : 0.05; }),
      kPrior);
  const std::vector<double> state = shares.state();
  const std::optional<LearnedShares> back = LearnedShares::ofState(state, 2);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->state(), state);
  for (float x = 0; x < 1; x += 0.01f) EXPECT_EQ(firstAt(*back, {x, x, 0}), firstAt(shares, {x, x, 0}));
  EXPECT_TRUE(LearnedShares::ofState(LearnedShares().state(), 2));
  EXPECT_FALSE(LearnedShares::ofState(state, 3));
  for (std::size_t n = 0; n < state.size(); ++n)
    EXPECT_FALSE(LearnedShares::ofState(std::span(state).first(n), 2)) << n;
  // No number of it makes a walk without an end.
  for (std::size_t n = 0; n < state.size(); ++n) {
    for (const double wrong : {-1.0, 0.0, 3.0, 1e9, std::nan("")}) {
      std::vector<double> broken = state;
      broken[n] = wrong;
      if (const auto taken = LearnedShares::ofState(broken, 2)) {
        EXPECT_EQ(taken->at({0.3f, 0.6f, 0}).size(), 2u);
      }
    }
  }
}

TEST(LightTreeSelector, LearnsWhatIsHidden) {
  // Two lamps alike, of which the first is behind a wall.
  const PointLight hidden(Transform(), {.from = {-1, 0, 5}}), seen(Transform(), {.from = {1, 0, 5}});
  const std::vector<const Illuminant*> lights{&hidden, &seen};
  const LightTreeSelector selector(lights, test::kBoxOfLights, /*learns=*/true);
  ASSERT_TRUE(selector.canLearn());
  EXPECT_FALSE(LightTreeSelector(lights, test::kBoxOfLights).canLearn());
  LightTrials trials;
  Rng rng(2);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Point3f p{rng.uniform() - 0.5f, rng.uniform(), 0};
    trials.startPath(i);
    const LightSelector::Choice c = selector.choose(p, rng.uniform());
    selector.note(p, c.light, c.light == 1 ? 1 / double{c.probability} : 0, trials);
  }
  EXPECT_NEAR(selector.probability(Point3f{}, 1), 0.5f, 1e-6f);
  const std::vector<double> learned = selector.learn(trials);
  EXPECT_GT(selector.probability(Point3f{}, 1), 0.9f);
  EXPECT_GT(selector.probability(Point3f{}, 0), 0.04f);
  EXPECT_FLOAT_EQ(selector.probability(Point3f{}, 0) + selector.probability(Point3f{}, 1), 1);

  const LightTreeSelector other(lights, test::kBoxOfLights, /*learns=*/true);
  ASSERT_TRUE(other.recall(learned));
  EXPECT_EQ(other.probability(Point3f{}, 1), selector.probability(Point3f{}, 1));
  EXPECT_FALSE(other.recall(std::span(learned).first(1)));
}

}  // namespace
}  // namespace pbrtmedia
