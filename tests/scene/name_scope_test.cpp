// SPDX-License-Identifier: BSD-2-Clause
#include "scene/name_scope.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pbrtmedia {
namespace {

using Kind = NameScope::Kind;

TEST(NameScope, HoldersOfAnOlderSnapshotKeepTheOldMeaning) {
  const NameScope::Ptr one = NameScope::with(nullptr, Kind::Materials, "a", 1);
  const NameScope::Ptr two = NameScope::with(one, Kind::Materials, "a", 2);
  EXPECT_EQ(NameScope::find(one, Kind::Materials, "a"), 1u);
  EXPECT_EQ(NameScope::find(two, Kind::Materials, "a"), 2u);
  EXPECT_EQ(NameScope::find(nullptr, Kind::Materials, "a"), std::nullopt);
}

TEST(NameScope, KindsAreSeparate) {
  NameScope::Ptr s = NameScope::with(nullptr, Kind::FloatTextures, "a", 1);
  s = NameScope::with(s, Kind::SpectrumTextures, "a", 2);
  EXPECT_EQ(NameScope::find(s, Kind::FloatTextures, "a"), 1u);
  EXPECT_EQ(NameScope::find(s, Kind::SpectrumTextures, "a"), 2u);
  EXPECT_EQ(NameScope::find(s, Kind::Materials, "a"), std::nullopt);
}

TEST(NameScope, ManySnapshotsAllAnswerRightly) {
  std::vector<NameScope::Ptr> snapshots{nullptr};
  constexpr std::uint32_t kCount = 500;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    snapshots.push_back(NameScope::with(snapshots.back(), Kind::Materials, std::to_string(i % 100), i));
  }
  for (std::uint32_t n = 1; n <= kCount; ++n) {
    for (std::uint32_t name = 0; name < 100; ++name) {
      const auto found = NameScope::find(snapshots[n], Kind::Materials, std::to_string(name));
      if (name >= n) {
        EXPECT_EQ(found, std::nullopt);
      } else {
        EXPECT_EQ(found, (n - 1 - name) / 100 * 100 + name);  // the last i < n with i % 100 == name
      }
    }
  }
  EXPECT_EQ(NameScope::names(snapshots.back(), Kind::Materials).size(), 100u);
}

TEST(NameScope, LocalDefinitionsOverManyGlobalOnesCostLittle) {
  // 10^4 global names and 10^5 definitions on top of them: quadratic cost would take minutes here.
  NameScope::Ptr global;
  for (std::uint32_t i = 0; i < 10000; ++i)
    global = NameScope::with(global, Kind::Materials, std::to_string(i), i);
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const NameScope::Ptr local = NameScope::with(global, Kind::Materials, "local", i);
    ASSERT_EQ(NameScope::find(local, Kind::Materials, "local"), i);
  }
  EXPECT_EQ(NameScope::find(global, Kind::Materials, "local"), std::nullopt);
  const auto names = NameScope::names(global, Kind::Materials);
  EXPECT_EQ(names.size(), 10000u);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

}  // namespace
}  // namespace pbrtmedia
