// SPDX-License-Identifier: BSD-2-Clause
#include "world/camera_medium.h"

#include <gtest/gtest.h>

#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using Mode = OverlapRule::Mode;
using test::rayOf;
using test::SceneKit;

TEST(CameraMedium, IsVacuumWithoutBoundaries) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .material = kit.black()});
  const auto scene = kit.finish();
  const CameraMedium camera(*scene, {0, 0, 0}, 0);
  EXPECT_TRUE(camera.state().isVacuum());
  EXPECT_TRUE(camera.warnings().empty());
}

TEST(CameraMedium, IsFoundInsideAndOutsideNestedBoundaries) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const Medium* smoke = kit.fog("smoke", Rgb(1), Rgb(0), {Mode::Add});
  kit.builder.addPrimitive({.shape = kit.box({-4, -4, -4}, {4, 4, 4}), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {smoke, nullptr}});
  const auto scene = kit.finish();
  EXPECT_EQ(CameraMedium(*scene, {0.1f, 0.2f, 0}, 0).state().describe(), "\"fog\" + \"smoke\"");
  EXPECT_EQ(CameraMedium(*scene, {2, 2, 0}, 0).state().describe(), "\"fog\"");
  EXPECT_EQ(CameraMedium(*scene, {8, 2, 0}, 0).state().describe(), "vacuum");
  EXPECT_TRUE(CameraMedium(*scene, {2, 2, 0}, 0).warnings().empty());
}

TEST(CameraMedium, IsFoundThroughOpaqueSurfaces) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  kit.builder.addPrimitive(
      {.shape = kit.box({-4, -4, -4}, {4, 4, 4}), .material = kit.black(), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.sphere({2, 0, 0}, 1.5f), .material = kit.black()});
  const auto scene = kit.finish();
  EXPECT_EQ(CameraMedium(*scene, {0, 0, 0}, 0).state().describe(), "\"fog\"");
}

TEST(CameraMedium, SaysWhenBoundariesDoNotAgree) {
  // Between two wide squares that name what is between them.
  const auto between = [](bool alike) {
    SceneKit kit;
    const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
    const Medium* mist = kit.fog("mist", Rgb(1), Rgb(0));
    kit.builder.addPrimitive({.shape = kit.square(-2, 500), .media = {nullptr, fog}});
    kit.builder.addPrimitive({.shape = kit.square(3, 500), .media = {alike ? fog : mist, nullptr}});
    const auto scene = kit.finish();
    const CameraMedium camera(*scene, {0, 0, 0}, 0);
    return std::pair{camera.state().describe(), camera.warnings()};
  };
  const auto [medium, warnings] = between(false);
  EXPECT_TRUE(medium == "\"fog\"" || medium == "\"mist\"") << medium;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("do not agree"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("directions say " + medium), std::string::npos) << warnings[0];
  const auto [same, none] = between(true);
  EXPECT_EQ(same, "\"fog\"");
  EXPECT_TRUE(none.empty());
}

TEST(CameraMedium, IsNotSoughtThroughHoles) {
  // A box without its lid, seen from above: whatever is behind the hole, nothing is around the camera.
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const Shape* wide = kit.quad({-9, -9, -1}, {-9, 9, -1}, {9, 9, -1}, {9, -9, -1});
  kit.builder.addPrimitive({.shape = wide, .media = {fog, nullptr}});
  const auto scene = kit.finish();
  const CameraMedium camera(*scene, {0, 0, 1}, 0);
  EXPECT_EQ(camera.state().describe(), "vacuum");
  EXPECT_TRUE(camera.warnings().empty());
}

TEST(CameraMedium, GivenIsUsedAndAContradictionNamesBoth) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const Medium* mist = kit.fog("mist", Rgb(1), Rgb(0));
  kit.builder.addPrimitive({.shape = kit.box({-4, -4, -4}, {4, 4, 4}), .media = {fog, nullptr}});
  const auto scene = kit.finish();
  const CameraMedium wrong(*scene, {1, 1, 0}, 0, mist);
  EXPECT_EQ(wrong.state().describe(), "\"mist\"");
  ASSERT_EQ(wrong.warnings().size(), 1u);
  EXPECT_NE(wrong.warnings()[0].find("\"mist\""), std::string::npos);
  EXPECT_NE(wrong.warnings()[0].find("\"fog\""), std::string::npos);
  EXPECT_TRUE(CameraMedium(*scene, {1, 1, 0}, 0, fog).warnings().empty());
  EXPECT_EQ(CameraMedium(*scene, {1, 1, 0}, 0, nullptr).warnings().size(), 1u);  // vacuum, said explicitly
  EXPECT_TRUE(CameraMedium(*scene, {9, 1, 0}, 0, mist).warnings().empty());  // outside nothing surrounds it
}

TEST(CameraMedium, GivenAddedMediumJoinsWhatGeometrySays) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const Medium* haze = kit.fog("haze", Rgb(1), Rgb(0), {Mode::Add});
  kit.builder.addPrimitive({.shape = kit.box({-4, -4, -4}, {4, 4, 4}), .media = {fog, nullptr}});
  const auto scene = kit.finish();
  EXPECT_EQ(CameraMedium(*scene, {1, 1, 0}, 0, haze).state().describe(), "\"fog\" + \"haze\"");
}

TEST(CameraMedium, IsFoundThroughInstancesWithTheirPlacement) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const auto object =
      kit.builder.addObject({{.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fog, nullptr}}});
  kit.builder.addInstance(object, AnimatedTransform(Transform::translate({5, 0, 0})));
  const auto scene = kit.finish();
  const CameraMedium inside(*scene, {5, 0.5f, 0}, 0);
  EXPECT_EQ(inside.state().describe(), "\"fog\"");
  EXPECT_NE(inside.state().boundary().placement, nullptr);
  EXPECT_TRUE(CameraMedium(*scene, {0, 0, 0}, 0).state().isVacuum());
}

TEST(CameraMedium, FollowsRaysThatStartElsewhere) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fog, nullptr}});
  const auto scene = kit.finish();
  RenderCounters counters;
  const MediaTopology camera(*scene, CameraMedium(*scene, {0, 0, 5}, 0));
  EXPECT_EQ(camera.stateOf(rayOf({0, 0, 5}, {0, 0, -1}), counters).describe(), "vacuum");
  EXPECT_EQ(camera.stateOf(rayOf({0.2f, 0.3f, 0.5f}, {0, 0, -1}), counters).describe(), "\"fog\"");
  EXPECT_EQ(camera.stateOf(rayOf({0.2f, 0.3f, -5}, {0, 0, -1}), counters).describe(), "vacuum");
  const MediaTopology given(*scene, CameraMedium(*scene, {0, 0, 5}, 0, fog));
  EXPECT_EQ(given.stateOf(rayOf({0.2f, 0.3f, -5}, {0, 0, -1}), counters).describe(), "\"fog\"");
}

}  // namespace
}  // namespace pbrtmedia
