// SPDX-License-Identifier: BSD-2-Clause
#include "image/signed_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "image/channels.h"

namespace pbrtmedia {
namespace {

/// `share`: of full colour, in [-1, 1].
Rgb colourOf(float share, ZeroColor zero) {
  const float size = std::abs(share), rest = zero == ZeroColor::White ? decodeSrgb(1 - size) : 0.0f,
              main = zero == ZeroColor::White ? 1.0f : decodeSrgb(size);
  return share < 0 ? Rgb(rest, rest, main) : Rgb(main, rest, rest);
}

}  // namespace

float usualSize(const Image& image) {
  requireColor(image);
  std::vector<float> sizes;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float size = std::abs(image.rgb(x, y).luminance());
      if (std::isfinite(size)) sizes.push_back(size);
    }
  }
  if (sizes.empty()) return 1;
  constexpr std::size_t kAbove = 200;
  const auto at = sizes.end() - 1 - static_cast<std::ptrdiff_t>(sizes.size() / kAbove);
  std::nth_element(sizes.begin(), at, sizes.end());
  if (*at > 0) return *at;
  const float largest = *std::max_element(sizes.begin(), sizes.end());
  return largest > 0 ? largest : 1;
}

Image signedColors(const Image& image, float full, ZeroColor zero) {
  requireColor(image);
  Image out(image.width(), image.height(), {"R", "G", "B"});
  out.dataWindow = image.dataWindow;
  out.displayWindow = image.displayWindow;
  out.metadata = image.metadata;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float value = image.rgb(x, y).luminance();
      out.setRgb(x, y,
                 std::isfinite(value) ? colourOf(std::clamp(value / full, -1.0f, 1.0f), zero) : Rgb(0, 1, 0));
    }
  }
  return out;
}

}  // namespace pbrtmedia
