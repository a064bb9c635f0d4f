// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "base/vec.h"
#include "image/image.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A picture as lights see it: values as stored (never gamma-decoded), resampled up to powers of two, row 0
/// at v = 0, bilinear between texel centres ((i + ½)/width, (j + ½)/height), repeated in both directions.
/// Immutable, thread-safe.
class LightMap {
 public:
  /// Throws std::invalid_argument for an empty picture or one with a texel that is not finite (named in the
  /// message).
  explicit LightMap(const Image& image);
  ~LightMap();
  LightMap(LightMap&&) noexcept;
  LightMap& operator=(LightMap&&) noexcept;

  int width() const { return width_; }    ///< after resampling
  int height() const { return height_; }  ///< after resampling
  Rgb texel(int x, int y) const;          ///< 0 <= x < width, 0 <= y < height
  Rgb lookup(Point2f uv) const;
  /// The coarsest pyramid texel: the mean.
  Rgb mean() const { return mean_; }
  /// width / height of the picture before resampling.
  float aspect() const { return aspect_; }

 private:
  struct Pyramid;
  std::unique_ptr<const Pyramid> pyramid_;
  int width_ = 0, height_ = 0;
  float aspect_ = 1;
  Rgb mean_;
};

}  // namespace pbrtmedia
