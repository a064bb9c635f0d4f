// SPDX-License-Identifier: BSD-2-Clause
#include "display/changed_tiles.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

TEST(ChangedTiles, CoverTheImageOnceWhenThereWasNone) {
  const Image image(10, 7);
  const std::vector<Bounds2i> tiles = changedTiles(nullptr, image, 4);
  ASSERT_EQ(tiles.size(), 6u);
  std::vector<int> covered(70);
  for (const Bounds2i& tile : tiles) {
    for (int y = tile.min.y; y < tile.max.y; ++y)
      for (int x = tile.min.x; x < tile.max.x; ++x) ++covered[static_cast<std::size_t>(10 * y + x)];
  }
  for (const int times : covered) EXPECT_EQ(times, 1);
}

TEST(ChangedTiles, AreThoseWithAChangedNumber) {
  const Image before(10, 7, {"R", "G", "B", "Z"});
  Image after = before;
  EXPECT_TRUE(changedTiles(&before, after, 4).empty());
  after.at(9, 6, 3) = 1;  // the last number there is
  ASSERT_EQ(changedTiles(&before, after, 4).size(), 1u);
  EXPECT_EQ(changedTiles(&before, after, 4)[0], (Bounds2i{{8, 4}, {10, 7}}));
  after.at(3, 3, 0) = 1;
  EXPECT_EQ(changedTiles(&before, after, 4)[0], (Bounds2i{{0, 0}, {4, 4}}));
  EXPECT_EQ(changedTiles(&before, after, 4).size(), 2u);
}

TEST(ChangedTiles, AreAllWhenTheImageIsAnother) {
  const Image small(4, 4), wide(8, 2), layered(4, 4, {"R", "G", "Z"});
  EXPECT_EQ(changedTiles(&small, small, 2).size(), 0u);
  EXPECT_EQ(changedTiles(&small, wide, 2).size(), 4u);
  EXPECT_EQ(changedTiles(&small, layered, 2).size(), 4u);
}

TEST(ChangedTiles, OfAnEmptyImageAreNone) { EXPECT_TRUE(changedTiles(nullptr, Image(0, 0), 4).empty()); }

}  // namespace
}  // namespace pbrtmedia
