// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/assemble.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>

namespace pbrtmedia {
namespace {

void requireFits(const NamedImage& first, const NamedImage& tile) {
  const Bounds2i &display = first.image.displayWindow, &data = tile.image.dataWindow;
  if (!(tile.image.displayWindow == display)) {
    throw std::runtime_error(first.name + " and " + tile.name + ": different display windows: " +
                             toString(display) + " and " + toString(tile.image.displayWindow));
  }
  if (tile.image.channels() != first.image.channels()) {
    throw std::runtime_error(first.name + " and " + tile.name + ": different channels");
  }
  if (!(intersect(data, display) == data)) {
    throw std::runtime_error(tile.name + ": the data window " + toString(data) +
                             " leaves the display window " + toString(display));
  }
}

/// Copies a tile's pixel; returns whether that changed a value.
bool copyPixel(Image& out, Point2i to, const Image& tile, Point2i from) {
  bool changed = false;
  for (std::size_t c = 0; c < out.channelCount(); ++c) {
    changed |= out.at(to.x, to.y, c) != tile.at(from.x, from.y, c);
    out.at(to.x, to.y, c) = tile.at(from.x, from.y, c);
  }
  return changed;
}

void addTile(Assembly& result, std::vector<char>& covered, const Image& tile) {
  const Point2i offset = tile.dataWindow.min - result.image.displayWindow.min;
  for (int y = 0; y < tile.height(); ++y) {
    for (int x = 0; x < tile.width(); ++x) {
      const Point2i to = Point2i{x, y} + offset;
      const bool changed = copyPixel(result.image, to, tile, {x, y});
      char& isCovered =
          covered[static_cast<std::size_t>(to.y) * static_cast<std::size_t>(result.image.width()) +
                  static_cast<std::size_t>(to.x)];
      if (isCovered) {
        ++result.overlapping;
        if (changed) ++result.contradicting;
      }
      isCovered = 1;
    }
  }
}

}  // namespace

Assembly assembleTiles(const std::vector<NamedImage>& tiles) {
  if (tiles.empty()) throw std::runtime_error("nothing to assemble");
  const NamedImage& first = tiles.front();
  const Bounds2i display = first.image.displayWindow;
  std::uint64_t pixelsThere = 0;
  for (const NamedImage& tile : tiles) {
    requireFits(first, tile);
    pixelsThere += static_cast<std::uint64_t>(tile.image.dataWindow.area());
  }
  // A header may claim any display window; a picture that is almost only gap is a mistake, not a request.
  constexpr std::int64_t kMaxPixels = std::int64_t{1} << 32;
  if (display.area() > kMaxPixels) {
    throw std::runtime_error(first.name + ": the display window " + toString(display) +
                             " is too large, with " + std::to_string(pixelsThere) + " pixels in the tiles");
  }
  Assembly result;
  result.image = Image(display.width(), display.height(), first.image.channels());
  result.image.dataWindow = result.image.displayWindow = display;
  result.image.metadata = first.image.metadata;
  std::vector<char> covered(static_cast<std::size_t>(display.area()));
  for (const NamedImage& tile : tiles) {
    addTile(result, covered, tile.image);
    std::erase_if(result.image.metadata, [&](const auto& entry) {
      const auto other = tile.image.metadata.find(entry.first);
      return other == tile.image.metadata.end() || other->second != entry.second;
    });
  }
  // Where one tile lacks extinction, so does the picture.
  const auto isRising = [](const NamedImage& tile) {
    const auto state = tile.image.metadata.find("boundsState");
    return state != tile.image.metadata.end() && state->second == "rising";
  };
  if (std::any_of(tiles.begin(), tiles.end(), isRising)) result.image.metadata["boundsState"] = "rising";
  std::vector<const Image*> images;
  for (const NamedImage& tile : tiles) images.push_back(&tile.image);
  for (const char* key : {"command", "version"}) {
    if (const std::string lines = eachOf(images, key); !lines.empty()) result.image.metadata[key] = lines;
  }
  result.missing = std::count(covered.begin(), covered.end(), 0);
  if (result.missing > 0) {
    const std::int64_t at = std::find(covered.begin(), covered.end(), 0) - covered.begin();
    result.firstMissing =
        display.min + Point2i{static_cast<int>(at % display.width()), static_cast<int>(at / display.width())};
  }
  return result;
}

int runAssemble(const AssembleOptions& options) {
  requireWritable(options.outfile);
  std::vector<NamedImage> tiles;
  for (const std::string& file : options.inputs) {
    LoadedImage loaded = loadLinear(file);
    if (loaded.format != ImageFormat::Exr)
      throw std::runtime_error(file + ": only EXR tiles can be assembled");
    tiles.push_back({file, std::move(loaded.image)});
  }
  const Assembly result = assembleTiles(tiles);
  if (tiles.front().image.metadata.count("sceneHash") > result.image.metadata.count("sceneHash")) {
    std::cout << "the tiles are renders of different scenes (metadata \"sceneHash\")\n";
  }
  if (result.overlapping > 0) {
    std::cout << "overlaps: " << result.overlapping << " pixels, " << result.contradicting
              << " of them with different values; the last tile counts\n";
  }
  if (result.missing > 0) {
    std::cout << "gaps: " << result.missing << " pixels of no tile, the first at " << result.firstMissing
              << '\n';
    if (!options.allowGaps) {
      throw std::runtime_error(options.outfile + ": not written because of the gaps (--allow-gaps)");
    }
  }
  writeImage(options.outfile, result.image, options.write);
  return 0;
}

}  // namespace pbrtmedia
