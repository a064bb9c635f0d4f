// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/rng.h"
#include "lighting/light_importance.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMinPValue;

std::vector<LightTree::Source> someSources(std::size_t count) {
  std::vector<LightTree::Source> sources;
  Rng rng(5);
  const auto within = [&](float r) { return r * (2 * rng.uniform() - 1); };
  for (std::size_t i = 0; i < count; ++i) {
    LightExtent e;
    const Point3f p{within(10), within(10), within(2)};
    e.bounds = {p, p + Vector3f{rng.uniform(), rng.uniform(), rng.uniform()}};
    e.axis = normalize(Vector3f{within(1), within(1), within(1) + 1e-3f});
    e.spread = i % 4 == 0 ? std::numbers::pi_v<float> : rng.uniform();
    e.fade = i % 2 == 0 ? 0.0f : std::numbers::pi_v<float> / 2;
    sources.push_back({e, 0.1 + static_cast<double>(rng.uniform())});
  }
  return sources;
}

auto at(Point3f p) {
  return [p](const LightTree::Node& node) { return importanceAt(LightReceiver(p), node); };
}

TEST(LightTree, ProbabilitiesOfAllLightsSumToOneBelowEveryNode) {
  for (const std::size_t count : {1u, 2u, 3u, 17u, 300u}) {
    const LightTree tree(someSources(count));
    ASSERT_EQ(tree.nodeCount(), 2 * count - 1);
    for (const Point3f p : {Point3f{0, 0, 0}, Point3f{9, -9, 1}, Point3f{1e4f, 0, 0}}) {
      double sum = 0;
      for (std::size_t i = 0; i < count; ++i) sum += tree.probability(0, i, at(p));
      EXPECT_NEAR(sum, 1, 1e-12);
    }
  }
  const LightTree tree(someSources(40));
  const std::uint32_t part = tree.node(0).right;
  double sum = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    if (tree.leafOf(i) >= part) sum += tree.probability(part, i, at({1, 2, 3}));
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(LightTree, ChoosesWithTheProbabilitiesItStates) {
  constexpr std::size_t kLights = 300;
  constexpr int kCount = 300000;
  const LightTree tree(someSources(kLights));
  std::vector<double> observed(kLights), expected(kLights);
  Rng rng(7);
  for (int i = 0; i < kCount; ++i) {
    const LightTree::Choice c = tree.choose(0, rng.uniformDouble(), at({2, 1, 0}));
    EXPECT_NEAR(c.probability, tree.probability(0, c.source, at({2, 1, 0})), 1e-12);
    ++observed[c.source];
  }
  for (std::size_t i = 0; i < kLights; ++i) expected[i] = kCount * tree.probability(0, i, at({2, 1, 0}));
  const test::ChiSquareTest right = test::chiSquareTest(observed, expected);
  EXPECT_GT(right.pValue(), kMinPValue) << right;
  // The test sees the probabilities of a point beside.
  for (std::size_t i = 0; i < kLights; ++i) expected[i] = kCount * tree.probability(0, i, at({2, 1.5f, 0}));
  const test::ChiSquareTest wrong = test::chiSquareTest(observed, expected);
  EXPECT_LT(wrong.pValue(), kMinPValue) << wrong;
}

TEST(LightTree, NodesHoldWhatIsBelowThem) {
  const std::vector<LightTree::Source> sources = someSources(300);
  const LightTree tree(sources);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const LightExtent& e = sources[i].extent;
    for (std::uint32_t n = tree.leafOf(i);; n = tree.node(n).parent) {
      const LightTree::Node& node = tree.node(n);
      for (int corner = 0; corner < 8; ++corner)
        EXPECT_LE(length(e.bounds.corner(corner) - node.centre), node.radius * 1.0001f + 1e-5f);
      const double between = std::acos(std::clamp(double{dot(e.axis, node.axis)}, -1.0, 1.0));
      const double spread = std::acos(std::clamp(double{node.cosSpread}, -1.0, 1.0));
      EXPECT_LE(std::min(between + double{e.spread}, std::numbers::pi), spread + 2e-3);
      EXPECT_LE(node.cosFade, std::cos(e.fade) + 1e-6f);
      if (n == 0) break;
    }
  }
  double sum = 0;
  for (const LightTree::Source& s : sources) sum += s.intensity;
  EXPECT_NEAR(tree.node(0).intensity, sum, 1e-5 * sum);
}

TEST(LightTree, IsAsDeepAsALogarithm) {
  const std::size_t count = 10000;
  const LightTree tree(someSources(count));
  double asked = 0;
  for (std::size_t i = 0; i < count; i += 7) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    tree.choose(0, u, [&](const LightTree::Node& node) { return ++asked, double{node.intensity}; });
  }
  // Two importances a step, and no more than twice the 13.3 steps of a balanced tree.
  EXPECT_LT(asked / (count / 7.0), 2 * 2 * 13.3);
}

TEST(LightTree, TakesLightsThatAreAllInOnePlace) {
  std::vector<LightTree::Source> sources(1000, {LightExtent{.bounds = {{1, 2, 3}, {1, 2, 3}}}, 2.0});
  const LightTree tree(sources);
  for (const Point3f p : {Point3f{1, 2, 3}, Point3f{4, 4, 4}}) {
    for (std::size_t i = 0; i < sources.size(); ++i)
      EXPECT_NEAR(tree.probability(0, i, at(p)), 1e-3, 3e-4);  // 1000 is no power of two
  }
}

TEST(LightImportance, OfOneSmallLightIsWhatArrives) {
  LightExtent e{.bounds = {{0, 0, 2}, {0, 0, 2}}, .axis = {0, 0, -1}, .spread = 0};
  const LightTree tree(std::vector<LightTree::Source>{{e, 3.0}});
  LightReceiver receiver(Point3f{0, 0, 0});
  EXPECT_NEAR(importanceAt(receiver, tree.node(0)), 3.0 / 4, 1e-6);
  receiver.n = normalize(Vector3f{0, 1, 1});
  EXPECT_NEAR(importanceAt(receiver, tree.node(0)), 3.0 / 4 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(importanceAt(LightReceiver({2, 0, 0}), tree.node(0)), 3.0 / 8 * std::sqrt(0.5), 1e-6);
  // Behind it is dark, but for a small part.
  EXPECT_NEAR(importanceAt(LightReceiver({0, 0, 4}), tree.node(0)), 3.0 / 4 * 0.02, 1e-6);
  // On a line at distance 2, from -2 to 2 of its foot: an angle of π/2 over the distance.
  e.spread = std::numbers::pi_v<float>;
  const LightTree all(std::vector<LightTree::Source>{{e, 3.0}});
  EXPECT_NEAR(importanceAlong({0, 0, 0}, {1, 0, 0}, -2, 2, all.node(0)), 3 * std::numbers::pi / 4, 1e-9);
  EXPECT_NEAR(importanceAlong({0, 0, 0}, {2, 0, 0}, -1, 1, all.node(0)), 3 * std::numbers::pi / 4, 1e-9);
  EXPECT_NEAR(importanceAlong({0, 0, 0}, {1, 0, 0}, 0, std::numeric_limits<double>::infinity(), all.node(0)),
              3 * std::numbers::pi / 4, 1e-9);
}

}  // namespace
}  // namespace pbrtmedia
