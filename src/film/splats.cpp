// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "film/film.h"

namespace pbrtmedia {
namespace {

/// Rows that one thread sums at a time: it looks at every splat of the call.
constexpr int kRowsAtATime = 32;

/// The pixel whose samples lie where the splat does.
Point2i pixelOf(Point2f film) {
  return {static_cast<int>(std::floor(film.x)), static_cast<int>(std::floor(film.y))};
}

}  // namespace

void Film::addSplats(std::span<const SplatBuffer> units, std::uint64_t paths, double area) {
  state_.splatPaths += paths;
  state_.splatArea = area;
  if (state_.splats.empty()) state_.splats.resize(state_.sums.size());
  const int rows = endRow_ - firstRow_;
  const int parts = (rows + kRowsAtATime - 1) / kRowsAtATime;
  parallelFor(static_cast<std::size_t>(parts), [&](std::size_t part) {
    const int firstRow = firstRow_ + static_cast<int>(part) * kRowsAtATime;
    const int lastRow = std::min(firstRow + kRowsAtATime, endRow_) - 1;
    std::vector<const Splat*> splats;
    for (const SplatBuffer& unit : units) {
      for (const Splat& splat : unit.splats()) {
        // Samples of the pixel k away reach a pixel for firstNeighbour <= k <= lastNeighbour.
        const float y = std::floor(splat.film.y);
        if (y >= static_cast<float>(firstRow + filter_.firstNeighbour().y) &&
            y <= static_cast<float>(lastRow + filter_.lastNeighbour().y))
          splats.push_back(&splat);
      }
    }
    std::stable_sort(splats.begin(), splats.end(),
                     [](const Splat* a, const Splat* b) { return a->order < b->order; });
    addSplatsToRows(splats, firstRow, lastRow);
  });
}

void Film::addSplatsToRows(std::span<const Splat* const> splats, int firstRow, int lastRow) {
  const Point2i first = filter_.firstNeighbour(), last = filter_.lastNeighbour();
  const double perIntegral = 1 / filter_.integral();
  for (const Splat* splat : splats) {
    if (!(splat->film.x >= static_cast<float>(sampleBounds_.min.x) &&
          splat->film.x < static_cast<float>(sampleBounds_.max.x)))
      continue;
    const Point2i from = pixelOf(splat->film);
    const Point2f offset{splat->film.x - static_cast<float>(from.x),
                         splat->film.y - static_cast<float>(from.y)};
    for (int y = std::max(firstRow, from.y - last.y); y <= std::min(lastRow, from.y - first.y); ++y) {
      for (int x = std::max(pixelBounds_.min.x, from.x - last.x);
           x <= std::min(pixelBounds_.max.x - 1, from.x - first.x); ++x) {
        const float* const weight = filter_.find(static_cast<float>(from.x - x) + offset.x - 0.5f,
                                                 static_cast<float>(from.y - y) + offset.y - 0.5f);
        if (!weight) continue;
        const double w = *weight * perIntegral;
        SplatSum& sum = state_.splats[static_cast<std::size_t>(y - pixelBounds_.min.y) *
                                          static_cast<std::size_t>(pixelBounds_.width()) +
                                      static_cast<std::size_t>(x - pixelBounds_.min.x)];
        sum.r += w * splat->value.r;
        sum.g += w * splat->value.g;
        sum.b += w * splat->value.b;
      }
    }
  }
}

}  // namespace pbrtmedia
