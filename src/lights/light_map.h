// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "base/vec.h"
#include "image/image.h"
#include "image/mip_map.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A picture as lights see it: values as stored (never gamma-decoded), resampled up to powers of two, row 0
/// at v = 0, bilinear between texel centres ((i + ½)/width, (j + ½)/height), repeated in both directions.
/// Immutable, thread-safe.
class LightMap {
 public:
  /// Throws std::invalid_argument for an empty picture or one with a texel that is not finite (named in the
  /// message), and its base std::logic_error for one that has no colours.
  explicit LightMap(const Image& image);

  int width() const { return pyramid_.width(); }    ///< after resampling
  int height() const { return pyramid_.height(); }  ///< after resampling
  /// 0 <= x < width, 0 <= y < height
  Rgb texel(int x, int y) const { return pyramid_.texel(0, x, y); }
  Rgb lookup(Point2f uv) const { return pyramid_.bilinear(uv); }
  /// The coarsest pyramid texel: the mean.
  Rgb mean() const { return pyramid_.coarsest(); }
  /// What samples by the picture go by: channel mean of |factor · picture| averaged over the cell of each
  /// texel, x fastest. Positive wherever the interpolated picture is not black.
  std::vector<float> cellMeans(Rgb factor) const;
  /// width / height of the picture before resampling.
  float aspect() const { return aspect_; }

 private:
  MipMap<Rgb> pyramid_;
  float aspect_;
};

}  // namespace pbrtmedia
