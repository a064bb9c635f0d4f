// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/resample.h"
#include "image/signed_colors.h"
#include "image/tonemap.h"
#include "tools/imgtool/common.h"

namespace pbrtmedia {

/// Options of `imgtool convert`, applied in the order of the members.
struct ConvertOptions {
  std::string input = {}, output = {};
  std::string layer = {};              ///< "": all channels
  std::vector<int> crop = {};          ///< empty, or x0 x1 y0 y1 in pixels of the file, upper ends exclusive
  std::optional<float> scale = {};     ///< factor
  std::optional<float> exposure = {};  ///< stops: factor 2^exposure
  std::optional<float> offset = {};    ///< added to values
  std::optional<float> despike = {};   ///< luminance from which a pixel may be replaced
  std::optional<float> bloomLevel = {};  ///< luminance from which a pixel glows
  BloomParams bloom = {};                ///< its level is `bloomLevel`
  bool toneMap = false;
  float maxLuminance = 1;
  bool preserveColors = false;
  bool isSigned = false;  ///< values are shown by signedColors
  ZeroColor zero = ZeroColor::White;
  std::string resize = {};  ///< empty, or "WxH"
  ResizeFilter resizeFilter = ResizeFilter::Box;
  int repeatPixels = 1;
  bool flipY = false;
  WriteOptions write = {};
};

/// The image after all steps. Metadata stay, but once values have changed, "samples" and "seed" are dropped,
/// so that `merge` cannot take the result for a render. Throws std::runtime_error for impossible options.
Image converted(Image image, const ConvertOptions& options);

/// `imgtool convert`. Returns 0.
int runConvert(const ConvertOptions& options);

}  // namespace pbrtmedia
