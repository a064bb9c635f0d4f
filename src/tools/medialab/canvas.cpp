// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/medialab/font.h"

namespace pbrtmedia {
namespace {

/// Oklab (Ottosson 2020) to sRGB components, cut to [0, 1].
Rgb fromOklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const auto encoded = [](double linear) {
    return encodeSrgb(static_cast<float>(std::clamp(linear, 0.0, 1.0)));
  };
  return {encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

LabCanvas::LabCanvas(int width, int height) : image_(width, height) {
  std::fill(image_.data().begin(), image_.data().end(), 1.0f);
}

void LabCanvas::set(int x, int y, Rgb colour) {
  if (x < 0 || y < 0 || x >= image_.width() || y >= image_.height()) return;
  image_.setRgb(x, y, {decodeSrgb(colour.r), decodeSrgb(colour.g), decodeSrgb(colour.b)});
}

void LabCanvas::fill(int x, int y, int width, int height, Rgb colour) {
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) set(x + i, y + j, colour);
  }
}

void LabCanvas::frame(int x, int y, int width, int height, Rgb colour) {
  fill(x - 1, y - 1, width + 2, 1, colour);
  fill(x - 1, y + height, width + 2, 1, colour);
  fill(x - 1, y - 1, 1, height + 2, colour);
  fill(x + width, y - 1, 1, height + 2, colour);
}

void LabCanvas::line(double x0, double y0, double x1, double y1, Rgb colour) {
  const int steps = static_cast<int>(std::ceil(std::max(std::abs(x1 - x0), std::abs(y1 - y0))));
  for (int i = 0; i <= steps; ++i) {
    const double t = steps > 0 ? static_cast<double>(i) / steps : 0;
    set(static_cast<int>(std::lround(x0 + t * (x1 - x0))), static_cast<int>(std::lround(y0 + t * (y1 - y0))),
        colour);
  }
}

void LabCanvas::text(int x, int y, std::string_view words, Rgb colour, int scale) {
  for (const char c : words) {
    const LabGlyph& glyph = labGlyph(c);
    for (int row = 0; row < kLabGlyphHeight; ++row) {
      for (int column = 0; column < kLabGlyphWidth; ++column) {
        if ((glyph[static_cast<std::size_t>(row)] >> (kLabGlyphWidth - 1 - column) & 1) == 0) continue;
        fill(x + column * scale, y + row * scale, scale, scale, colour);
      }
    }
    x += (kLabGlyphWidth + 1) * scale;
  }
}

int LabCanvas::textWidth(std::string_view words, int scale) {
  return static_cast<int>(words.size()) * (kLabGlyphWidth + 1) * scale;
}

Rgb sequentialColour(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return fromOklch(0.22 + 0.72 * t, 0.09 + 0.09 * t, (285 - 180 * t) * kDegree);
}

Rgb categoricalColour(std::size_t i) {
  constexpr double kGoldenAngle = 137.50776405;  // degrees: successive hues are far apart
  const double level = static_cast<double>(i % 3);
  return fromOklch(0.55 + 0.15 * level, 0.15, (30 + kGoldenAngle * static_cast<double>(i)) * kDegree);
}

}  // namespace pbrtmedia
