// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "image/image.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// What lies outside the unit square of an image.
enum class WrapMode { Repeat, Black, Clamp };

/// An image pyramid over the unit square; T is float or Rgb. Texel (x, y) of a level of w x h texels has its
/// centre at ((x + 1/2)/w, (y + 1/2)/h); row 0 is at t = 0.
///
/// Sides that are no powers of two are first resampled up with a Lanczos filter (2 texels, 2 lobes) and
/// clamped at 0, which keeps constants exactly; each coarser level averages 2 x 2 texels. Immutable,
/// thread-safe; non-finite coordinates read texel 0 instead of crashing.
template <class T>
class MipMap {
 public:
  /// `texels`: width * height values, x fastest. Throws std::invalid_argument when the count does not fit or
  /// a side is < 1.
  MipMap(int width, int height, std::vector<T> texels, WrapMode wrap = WrapMode::Repeat);

  /// Size of the finest level: powers of two.
  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }
  int levelCount() const { return static_cast<int>(levels_.size()); }
  WrapMode wrap() const { return wrap_; }

  /// Any integers: outside the level the wrap mode answers. `level` in [0, levelCount).
  T texel(int level, int x, int y) const;
  /// The one texel of the coarsest level: the average of the image.
  T coarsest() const { return levels_.back().texels.front(); }

  T bilinear(Point2f st, int level = 0) const;
  /// Isotropic footprint of `width` (units of st); blends two levels. 0 or NaN: bilinear at the finest level.
  T trilinear(Point2f st, float width) const;
  /// Elliptical weighted average with Gaussian weights e^(-2 r^2) - e^-2 (Heckbert 1989), the ellipse given
  /// by two axes of st. An ellipse thinner than 1 : `maxAnisotropy` is widened. A zero-length axis: bilinear
  /// at the finest level.
  T ewa(Point2f st, Vector2f axis0, Vector2f axis1, float maxAnisotropy) const;

 private:
  struct Level {
    int width, height;
    std::vector<T> texels;
  };
  T ewaLevel(int level, Point2f st, Vector2f axis0, Vector2f axis1) const;
  Point2f texelPosition(const Level& level, Point2f st) const;

  std::vector<Level> levels_;
  WrapMode wrap_;
};

/// The pyramid of a picture as environment, projection and goniometric lights see it: the image's top row is
/// at t = 0, values are not decoded.
MipMap<Rgb> makeLightMap(const Image& image, WrapMode wrap = WrapMode::Repeat);

extern template class MipMap<float>;
extern template class MipMap<Rgb>;

}  // namespace pbrtmedia
