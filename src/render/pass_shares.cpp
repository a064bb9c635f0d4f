// SPDX-License-Identifier: BSD-2-Clause
#include "render/pass_shares.h"

#include <glog/logging.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace pbrtmedia {
namespace {

/// So many tiles a thread can be shared evenly, as far as they are not too small to go through on their own.
constexpr std::int64_t kTilesPerThread = 8;
constexpr int kLeastEdge = 4;

}  // namespace

std::vector<Bounds2i> PassShares::tilesOf(Bounds2i bounds, int edge) {
  std::vector<Bounds2i> tiles;
  for (int y = bounds.min.y; y < bounds.max.y; y += edge) {
    for (int x = bounds.min.x; x < bounds.max.x; x += edge) {
      tiles.push_back(intersect(Bounds2i{{x, y}, {x + edge, y + edge}}, bounds));
    }
  }
  return tiles;
}

int PassShares::tileEdge(const Bounds2i& bounds, int edge, std::uint64_t threads) {
  const std::int64_t wanted = kTilesPerThread * static_cast<std::int64_t>(threads);
  while (edge > kLeastEdge && bounds.area() / (std::int64_t{edge} * edge) < wanted) edge = (edge + 1) / 2;
  return edge;
}

PassShares::PassShares(Plan plan) : plan_(std::move(plan)), taken_(plan_.ranks) {
  CHECK_GT(plan_.ranks, 0u);
  // Neighbours cost much the same: dealt out one by one, they do so before anything is measured.
  for (std::size_t tile = 0; tile < plan_.tiles.size(); ++tile) taken_[tile % plan_.ranks].push_back(tile);
}

RowRange PassShares::summedBy(std::size_t rank) const {
  const auto height = static_cast<std::size_t>(plan_.film.height());
  const auto edge = [&](std::size_t r) {
    return plan_.film.min.y + static_cast<int>(height * r / plan_.ranks);
  };
  return {edge(rank), edge(rank + 1)};
}

RowRange PassShares::neededBy(std::size_t rank) const {
  const RowRange rows = summedBy(rank);
  if (rows.isEmpty()) return {};
  return {rows.first + plan_.firstNeighbour, rows.end + plan_.lastNeighbour};
}

bool PassShares::needs(std::size_t rank, int row) const {
  const RowRange rows = neededBy(rank);
  return row >= rows.first && row < rows.end;
}

std::vector<Bounds2i> PassShares::sent(std::size_t from, std::size_t to) const {
  std::vector<Bounds2i> parts;
  const RowRange rows = neededBy(to);
  if (from == to || rows.isEmpty()) return parts;
  for (const std::size_t number : taken_[from]) {
    Bounds2i part = plan_.tiles[number];
    part.min.y = std::max(part.min.y, rows.first);
    part.max.y = std::min(part.max.y, rows.end);
    if (part.min.y < part.max.y) parts.push_back(part);
  }
  return parts;
}

std::vector<std::size_t> PassShares::sendersTo(std::size_t rank) const {
  std::vector<std::size_t> senders;
  for (std::size_t from = 0; from < plan_.ranks; ++from) {
    if (!sent(from, rank).empty()) senders.push_back(from);
  }
  return senders;
}

void PassShares::balance(std::span<const std::uint64_t> costs) {
  CHECK_EQ(costs.size(), plan_.tiles.size());
  std::vector<std::size_t> dearestFirst(costs.size());
  std::iota(dearestFirst.begin(), dearestFirst.end(), std::size_t{0});
  std::stable_sort(dearestFirst.begin(), dearestFirst.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  using Load = std::pair<std::uint64_t, std::size_t>;  // and its rank
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (std::size_t rank = 0; rank < plan_.ranks; ++rank) least.emplace(0, rank);
  for (std::vector<std::size_t>& tiles : taken_) tiles.clear();
  for (const std::size_t tile : dearestFirst) {
    const auto [load, rank] = least.top();
    least.pop();
    taken_[rank].push_back(tile);
    least.emplace(load + costs[tile] + 1, rank);  // tiles that cost nothing are dealt out too
  }
  for (std::vector<std::size_t>& tiles : taken_) std::sort(tiles.begin(), tiles.end());
}

}  // namespace pbrtmedia
