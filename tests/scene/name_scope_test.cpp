// SPDX-License-Identifier: BSD-2-Clause
#include "scene/name_scope.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace pbrtmedia
