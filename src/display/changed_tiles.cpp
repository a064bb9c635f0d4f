// SPDX-License-Identifier: BSD-2-Clause
#include "display/changed_tiles.h"

#include <cstring>

namespace pbrtmedia {
namespace {

bool isChanged(const Image& before, const Image& after, Bounds2i tile) {
  const std::size_t channels = after.channelCount();
  const std::size_t bytes = static_cast<std::size_t>(tile.width()) * channels * sizeof(float);
  for (int y = tile.min.y; y < tile.max.y; ++y) {
    const std::size_t first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(after.width()) +
                               static_cast<std::size_t>(tile.min.x)) *
                              channels;
    if (std::memcmp(before.data().data() + first, after.data().data() + first, bytes) != 0) return true;
  }
  return false;
}

}  // namespace

std::vector<Bounds2i> changedTiles(const Image* before, const Image& after, int edge) {
  const bool isComparable = before && before->width() == after.width() &&
                            before->height() == after.height() && before->channels() == after.channels();
  const Bounds2i whole{{0, 0}, {after.width(), after.height()}};
  std::vector<Bounds2i> tiles;
  for (int y = 0; y < after.height(); y += edge) {
    for (int x = 0; x < after.width(); x += edge) {
      const Bounds2i tile = intersect(Bounds2i{{x, y}, {x + edge, y + edge}}, whole);
      if (!isComparable || isChanged(*before, after, tile)) tiles.push_back(tile);
    }
  }
  return tiles;
}

}  // namespace pbrtmedia
