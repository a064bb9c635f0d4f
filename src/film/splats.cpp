// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/built_parts.h"
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

SplatSum weighted(Rgb value, double weight) {
  return {weight * static_cast<double>(value.r), weight * static_cast<double>(value.g),
          weight * static_cast<double>(value.b)};
}

}  // namespace

void Film::addSplats(std::span<const SplatBuffer> units, const SplatPaths& paths, std::uint64_t oddPaths) {
  state_.paths.count += paths.count;
  state_.paths.area = paths.area;
  state_.oddPaths += oddPaths;
  if (state_.splats.empty()) countBuilt(Part::SplatBuffers);
  state_.splats.resize(state_.sums.size());
  if (hasHalves()) state_.oddSplats.resize(state_.sums.size());
  if (settings_.layers.has(Layer::Variance)) state_.splatSquares.resize(state_.sums.size());
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
    if (!state_.splatSquares.empty()) addSquaresToRows(splats, firstRow, lastRow);
  });
}

template <class Visit>
void Film::visitReached(const Splat& splat, int firstRow, int lastRow, const Visit& visit) const {
  if (!(splat.film.x >= static_cast<float>(sampleBounds_.min.x) &&
        splat.film.x < static_cast<float>(sampleBounds_.max.x)))
    return;
  const Point2i first = filter_.firstNeighbour(), last = filter_.lastNeighbour();
  const Point2i from = pixelOf(splat.film);
  const Point2f offset{splat.film.x - static_cast<float>(from.x), splat.film.y - static_cast<float>(from.y)};
  for (int y = std::max(firstRow, from.y - last.y); y <= std::min(lastRow, from.y - first.y); ++y) {
    for (int x = std::max(pixelBounds_.min.x, from.x - last.x);
         x <= std::min(pixelBounds_.max.x - 1, from.x - first.x); ++x) {
      const float* const weight = filter_.find(static_cast<float>(from.x - x) + offset.x - 0.5f,
                                               static_cast<float>(from.y - y) + offset.y - 0.5f);
      if (!weight) continue;
      visit(
          static_cast<std::size_t>(y - pixelBounds_.min.y) * static_cast<std::size_t>(pixelBounds_.width()) +
              static_cast<std::size_t>(x - pixelBounds_.min.x),
          double{*weight});
    }
  }
}

void Film::addSplatsToRows(std::span<const Splat* const> splats, int firstRow, int lastRow) {
  const double perIntegral = 1 / filter_.integral();
  for (const Splat* splat : splats) {
    const bool isOfHalf = splat->isOdd && hasHalves();
    visitReached(*splat, firstRow, lastRow, [&](std::size_t pixel, double weight) {
      const SplatSum value = weighted(splat->value, weight * perIntegral);
      state_.splats[pixel] += value;
      if (isOfHalf) state_.oddSplats[pixel] += value;
    });
  }
}

void Film::addSquaresToRows(std::span<const Splat* const> splats, int firstRow, int lastRow) {
  const double scale = 1 / filter_.integral();
  std::vector<std::pair<std::size_t, SplatSum>> ofPath;  // pixels and what the path brings there: few
  for (std::size_t first = 0, end = 0; first < splats.size(); first = end) {
    ofPath.clear();
    for (end = first; end < splats.size() && splats[end]->order == splats[first]->order; ++end) {
      visitReached(*splats[end], firstRow, lastRow, [&](std::size_t pixel, double weight) {
        const auto at =
            std::find_if(ofPath.begin(), ofPath.end(), [&](const auto& p) { return p.first == pixel; });
        SplatSum& sum = at != ofPath.end() ? at->second : ofPath.emplace_back(pixel, SplatSum{}).second;
        sum += weighted(splats[end]->value, weight * scale);
      });
    }
    for (const auto& [pixel, sum] : ofPath)
      state_.splatSquares[pixel] += {sum.r * sum.r, sum.g * sum.g, sum.b * sum.b};
  }
}

}  // namespace pbrtmedia
