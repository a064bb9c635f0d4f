// SPDX-License-Identifier: BSD-2-Clause
#include "render/pass_shares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pbrtmedia {
namespace {

/// Squares of `edge` over `bounds`.
std::vector<Bounds2i> squares(Bounds2i bounds, int edge) {
  std::vector<Bounds2i> tiles;
  for (int y = bounds.min.y; y < bounds.max.y; y += edge) {
    for (int x = bounds.min.x; x < bounds.max.x; x += edge)
      tiles.push_back(intersect(Bounds2i{{x, y}, {x + edge, y + edge}}, bounds));
  }
  return tiles;
}

PassShares shares(std::size_t ranks) {
  return PassShares({.ranks = ranks,
                     .tiles = squares({{-2, 3}, {42, 30}}, 8),
                     .film = {{0, 5}, {40, 28}},
                     .firstNeighbour = -2,
                     .lastNeighbour = 2});
}

TEST(PassShares, EveryTileIsTakenOnceAndEveryRowSummedOnce) {
  for (const std::size_t ranks : {1u, 2u, 3u, 7u, 23u, 60u}) {
    PassShares all = shares(ranks);
    for (const bool isBalanced : {false, true}) {
      if (isBalanced) all.balance(std::vector<std::uint64_t>(all.tiles().size(), 5));
      std::vector<std::size_t> taken;
      int row = 5;
      for (std::size_t r = 0; r < ranks; ++r) {
        const auto tiles = all.takenBy(r);
        EXPECT_TRUE(std::is_sorted(tiles.begin(), tiles.end()));
        taken.insert(taken.end(), tiles.begin(), tiles.end());
        EXPECT_EQ(all.summedBy(r).first, row);
        row = all.summedBy(r).end;
        EXPECT_LE(all.summedBy(r).count(), (23 + static_cast<int>(ranks) - 1) / static_cast<int>(ranks));
      }
      EXPECT_EQ(row, 28);
      std::sort(taken.begin(), taken.end());
      std::vector<std::size_t> numbers(all.tiles().size());
      std::iota(numbers.begin(), numbers.end(), std::size_t{0});
      EXPECT_EQ(taken, numbers) << ranks;
    }
  }
}

TEST(PassShares, EveryRankGetsTheSamplesThatReachItsRows) {
  for (const std::size_t ranks : {2u, 5u, 40u}) {
    const PassShares all = shares(ranks);
    for (std::size_t to = 0; to < ranks; ++to) {
      const RowRange rows = all.summedBy(to);
      // Pixels that are there, or come.
      std::vector<int> got(44 * 27);
      const auto add = [&](const Bounds2i& part) {
        for (int y = part.min.y; y < part.max.y; ++y) {
          for (int x = part.min.x; x < part.max.x; ++x) ++got[static_cast<std::size_t>((y - 3) * 44 + x + 2)];
        }
      };
      for (const std::size_t tile : all.takenBy(to)) add(all.tiles()[tile]);
      std::vector<std::size_t> senders;
      for (std::size_t from = 0; from < ranks; ++from) {
        const auto parts = all.sent(from, to);
        for (const Bounds2i& part : parts) add(part);
        if (!parts.empty()) senders.push_back(from);
      }
      EXPECT_EQ(all.sendersTo(to), senders);
      for (int y = 3; y < 30; ++y) {
        const bool isNeeded = !rows.isEmpty() && y >= rows.first - 2 && y < rows.end + 2;
        EXPECT_EQ(all.needs(to, y), isNeeded);
        for (int x = 0; x < 44 && isNeeded; ++x)
          EXPECT_EQ(got[static_cast<std::size_t>((y - 3) * 44 + x)], 1) << to << ' ' << x - 2 << ' ' << y;
      }
      if (rows.isEmpty()) {
        EXPECT_TRUE(senders.empty());
      }
    }
  }
}

TEST(PassShares, BalancesWhatTilesCost) {
  PassShares all = shares(4);
  std::vector<std::uint64_t> costs;
  // The left edge costs a hundred times as much as the rest.
  for (std::size_t tile = 0; tile < all.tiles().size(); ++tile) costs.push_back(tile % 6 == 0 ? 1000 : 10);
  const auto loads = [&] {
    std::vector<std::uint64_t> sums(4);
    for (std::size_t r = 0; r < 4; ++r) {
      for (const std::size_t tile : all.takenBy(r)) sums[r] += costs[tile];
    }
    return sums;
  };
  const auto spread = [](const std::vector<std::uint64_t>& sums) {
    return static_cast<double>(*std::max_element(sums.begin(), sums.end())) * 4 /
           static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}));
  };
  EXPECT_GT(spread(loads()), 1.2) << "dealt out one by one";
  all.balance(costs);
  EXPECT_LT(spread(loads()), 1.02);
  // One tile costs as much as a third of all others: whoever has it takes nothing else.
  costs.assign(costs.size(), 10);
  costs[7] = 10 * (costs.size() - 1) / 3;
  all.balance(costs);
  EXPECT_LT(spread(loads()), 1.2);
}

}  // namespace
}  // namespace pbrtmedia
