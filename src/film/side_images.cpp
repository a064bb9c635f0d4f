// SPDX-License-Identifier: BSD-2-Clause
#include "film/side_images.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace pbrtmedia {

SideImages::SideImages(std::vector<SideImage> images, Point2i resolution)
    : images_(std::move(images)), resolution_(resolution) {
  const std::size_t pixels =
      static_cast<std::size_t>(resolution_.x) * static_cast<std::size_t>(resolution_.y);
  sums_.assign(images_.size(), std::vector<SplatSum>(pixels));
  samples_.resize(pixels);
}

void SideImages::add(std::span<const Unit> units, const SamplePass& pass, std::uint64_t paths) {
  paths_ += paths;
  const Bounds2i taken = intersect(pass.bounds(), {{0, 0}, resolution_});
  for (int slot = 0; slot < pass.samplesPerPixel(); ++slot) {
    for (int y = taken.min.y; y < taken.max.y; ++y) {
      for (int x = taken.min.x; x < taken.max.x; ++x) samples_[pixelAt(x, y)] += pass.at({x, y}, slot).valid;
    }
  }
  parallelFor(images_.size(), [&](std::size_t image) {
    std::vector<const Splat*> splats;
    for (const Unit& unit : units) {
      for (const Splat& splat : unit[image].splats()) splats.push_back(&splat);
    }
    std::stable_sort(splats.begin(), splats.end(),
                     [](const Splat* a, const Splat* b) { return a->order < b->order; });
    for (const Splat* splat : splats) {
      const Point2f p = splat->film;
      const bool isInside = p.x >= 0 && p.x < static_cast<float>(resolution_.x) && p.y >= 0 &&
                            p.y < static_cast<float>(resolution_.y);
      if (!isInside || !splat->value.isFinite()) continue;
      const Rgb v = splat->value;
      sums_[image][pixelAt(static_cast<int>(p.x), static_cast<int>(p.y))] +=
          {double{v.r}, double{v.g}, double{v.b}};
    }
  });
}

Image SideImages::develop(std::size_t image) const {
  Image developed(resolution_.x, resolution_.y);
  const SplatPaths paths{paths_, static_cast<double>(samples_.size())};
  for (int y = 0; y < resolution_.y; ++y) {
    for (int x = 0; x < resolution_.x; ++x) {
      const std::size_t pixel = pixelAt(x, y);
      SplatPaths behind = paths;
      if (!images_[image].isFromLights) behind = {samples_[pixel], 1};
      const SplatSum mean = behind.mean(sums_[image][pixel]);
      developed.setRgb(x, y,
                       {static_cast<float>(mean.r), static_cast<float>(mean.g), static_cast<float>(mean.b)});
    }
  }
  return developed;
}

}  // namespace pbrtmedia
