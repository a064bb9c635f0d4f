// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "image/image.h"

namespace pbrtmedia {

inline constexpr Rgb kInk{0.1f, 0.1f, 0.1f};  ///< of text and frames

/// A picture to draw plots on, white at first. Coordinates are pixels, y downwards; what lies outside is cut
/// off. Colours are sRGB components in [0, 1].
class LabCanvas {
 public:
  LabCanvas(int width, int height);

  void fill(int x, int y, int width, int height, Rgb colour);
  /// The border of a rectangle, one pixel wide, just outside of it.
  void frame(int x, int y, int width, int height, Rgb colour);
  void line(double x0, double y0, double x1, double y1, Rgb colour);
  /// Text with its upper left corner at (x, y); `scale` pixels a dot.
  void text(int x, int y, std::string_view words, Rgb colour = {}, int scale = 1);
  static int textWidth(std::string_view words, int scale = 1);

  /// The picture with linear values, as writeImage takes it.
  const Image& image() const { return image_; }

 private:
  void set(int x, int y, Rgb colour);
  Image image_;
};

/// From dark blue over green to bright yellow for t from 0 to 1; lightness rises evenly, so that it also
/// reads in grey.
Rgb sequentialColour(double t);
/// The i-th of a list of colours that differ in hue and lightness.
Rgb categoricalColour(std::size_t i);

}  // namespace pbrtmedia
