// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "film/sample_pass.h"
#include "film/splat_buffer.h"
#include "image/image.h"
#include "image/splat_sums.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// An image that an integrator makes besides that of the film.
struct SideImage {
  std::string name;  ///< of its file, without folder
  bool isFromLights =
      false;  ///< of light paths, which reach any pixel; else of what camera rays bring to theirs
};

/// What one camera sample adds to such images, in their order.
class SideSplats {
 public:
  /// `film`: where the camera's ray starts, raster; `rayWeight`: of that ray. `buffers` must outlive the
  /// object; they have begun the sample.
  SideSplats(std::span<SplatBuffer> buffers, Point2f film, float rayWeight)
      : buffers_(buffers), film_(film), rayWeight_(rayWeight) {}
  /// What the camera's ray brings to its own place.
  void addHere(std::size_t image, Rgb value) { buffers_[image].add(film_, rayWeight_ * value); }
  /// What a light path brings to some other.
  void add(std::size_t image, Point2f film, Rgb value) { buffers_[image].add(film, value); }

 private:
  std::span<SplatBuffer> buffers_;
  Point2f film_;
  float rayWeight_;
};

/// Such images of a whole picture, crop window or not, summed in double in a fixed order. Pixels are boxes:
/// means over the samples within them, without the film's filter, scale and limits.
class SideImages {
 public:
  /// `resolution`: of the whole picture.
  SideImages(std::vector<SideImage> images, Point2i resolution);
  /// What holds the splats of a unit of work: a buffer for each image.
  using Unit = std::vector<SplatBuffer>;
  /// Adds what the samples of a pass have brought, in order of Splat::order whatever the units. `paths`: how
  /// many light paths that were. Values that are no numbers are left out. Parallel over images.
  void add(std::span<const Unit> units, const SamplePass& pass, std::uint64_t paths);

  std::size_t count() const { return images_.size(); }
  const SideImage& description(std::size_t image) const { return images_[image]; }
  Image develop(std::size_t image) const;

 private:
  std::size_t pixelAt(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(resolution_.x) +
           static_cast<std::size_t>(x);
  }

  std::vector<SideImage> images_;
  Point2i resolution_;
  std::vector<std::vector<SplatSum>> sums_;  ///< by images, then row by row
  std::vector<std::uint64_t> samples_;       ///< of each pixel
  std::uint64_t paths_ = 0;
};

}  // namespace pbrtmedia
