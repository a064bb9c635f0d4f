// SPDX-License-Identifier: BSD-2-Clause
#include "world/medium_state.h"

#include <gtest/gtest.h>

#include <memory>

#include "media/homogeneous.h"

namespace pbrtmedia {
namespace {

using Mode = OverlapRule::Mode;

std::unique_ptr<Medium> medium(std::string name, Mode mode, int priority = 0) {
  return std::make_unique<HomogeneousMedium>(HomogeneousMedium::Params{.name = std::move(name),
                                                                       .sigmaA = Rgb(1),
                                                                       .sigmaS = Rgb(0),
                                                                       .phase = {PhaseLobe{}},
                                                                       .overlap = {mode, priority}});
}

TEST(MediumState, StartsAsVacuum) {
  const MediumState state;
  EXPECT_TRUE(state.isVacuum());
  EXPECT_EQ(state.describe(), "vacuum");
}

TEST(MediumState, HoldsOneBoundaryMedium) {
  const auto a = medium("a", Mode::Boundary), b = medium("b", Mode::Boundary);
  MediumState state(PlacedMedium{a.get()});
  state.setBoundary({b.get()});
  ASSERT_EQ(state.activeCount(), 1u);
  EXPECT_EQ(state.active(0).medium, b.get());
  state.setBoundary({});
  EXPECT_TRUE(state.isVacuum());
}

TEST(MediumState, AddsMediaOnTopOfTheBoundaryMedium) {
  const auto fog = medium("fog", Mode::Boundary), smoke = medium("smoke", Mode::Add);
  MediumState state(PlacedMedium{fog.get()});
  state.enter({smoke.get()});
  EXPECT_EQ(state.activeCount(), 2u);
  EXPECT_EQ(state.describe(), "\"fog\" + \"smoke\"");
  EXPECT_TRUE(state.leave({smoke.get()}));
  EXPECT_EQ(state.describe(), "\"fog\"");
}

TEST(MediumState, CountsAMediumAsOftenAsItWasEntered) {
  const auto smoke = medium("smoke", Mode::Add);
  MediumState state;
  state.enter({smoke.get()});
  state.enter({smoke.get()});
  EXPECT_EQ(state.activeCount(), 2u);
  EXPECT_TRUE(state.leave({smoke.get()}));
  EXPECT_EQ(state.count({smoke.get()}), 1u);
  EXPECT_TRUE(state.leave({smoke.get()}));
  EXPECT_FALSE(state.leave({smoke.get()}));
  EXPECT_TRUE(state.isVacuum());
}

TEST(MediumState, LetsOnlyTheHighestPriorityCount) {
  const auto low = medium("low", Mode::Priority, 1), high = medium("high", Mode::Priority, 2);
  const auto added = medium("added", Mode::Add);
  MediumState state;
  state.enter({low.get()});
  state.enter({high.get()});
  state.enter({added.get()});
  ASSERT_EQ(state.activeCount(), 2u);
  EXPECT_EQ(state.active(0).medium, added.get());
  EXPECT_EQ(state.active(1).medium, high.get());
  EXPECT_TRUE(state.leave({high.get()}));
  EXPECT_EQ(state.active(1).medium, low.get());
}

TEST(MediumState, DecidesEqualPrioritiesByNameWhateverTheOrder) {
  const auto a = medium("a", Mode::Priority, 1), b = medium("b", Mode::Priority, 1);
  MediumState first, second;
  first.enter({a.get()});
  first.enter({b.get()});
  second.enter({b.get()});
  second.enter({a.get()});
  ASSERT_EQ(first.activeCount(), 1u);
  EXPECT_EQ(first.active(0).medium, a.get());
  EXPECT_EQ(second.active(0).medium, a.get());
  EXPECT_TRUE(first == second);
}

TEST(MediumState, HasNoLimitOfNesting) {
  std::vector<std::unique_ptr<Medium>> media;
  MediumState state;
  for (int i = 0; i < 100; ++i) {
    media.push_back(medium(std::to_string(i), Mode::Add));
    state.enter({media.back().get()});
  }
  EXPECT_EQ(state.activeCount(), 100u);
  const MediumState copy = state;
  for (int i = 0; i < 100; i += 2) EXPECT_TRUE(state.leave({media[static_cast<std::size_t>(i)].get()}));
  ASSERT_EQ(state.activeCount(), 50u);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(state.active(i).medium, media[2 * i + 1].get());
  EXPECT_EQ(copy.activeCount(), 100u);
  EXPECT_FALSE(copy == state);
}

TEST(MediumState, KeepsPlacementsOfOneMediumApart) {
  const auto smoke = medium("smoke", Mode::Add);
  const Placement here(0, AnimatedTransform()), there(0, AnimatedTransform());
  MediumState state;
  state.enter({smoke.get(), &here});
  EXPECT_FALSE(state.leave({smoke.get(), &there}));
  EXPECT_TRUE(state.leave({smoke.get(), &here}));
}

}  // namespace
}  // namespace pbrtmedia
