// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/convert.h"

#include <charconv>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "tools/imgtool/layers.h"

namespace pbrtmedia {
namespace {

Point2i parseSize(const std::string& text) {
  const char *end = text.data() + text.size(), *at = text.data();
  Point2i size;
  const auto width = std::from_chars(at, end, size.x);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.y);
    constexpr int kMaxSide = 1 << 17;
    if (height.ec == std::errc() && height.ptr == end && size.x > 0 && size.y > 0 && size.x <= kMaxSide &&
        size.y <= kMaxSide) {
      return size;
    }
  }
  throw std::runtime_error("--resize needs WIDTHxHEIGHT with sides from 1 to 131072, found \"" + text + "\"");
}

/// The luminance that is shown in full colour: 1 of what was scaled on demand.
float fullColor(const Image& image, const ConvertOptions& options) {
  return options.scale || options.exposure ? 1.0f : usualSize(image);
}

/// What the colours mean, in the units of the file.
void tellScale(const Image& image, const ConvertOptions& options) {
  ConvertOptions before = options;  // the steps up to there
  before.isSigned = false;
  before.resize.clear();
  before.repeatPixels = 1;
  before.flipY = false;
  const float factor = options.scale.value_or(1.0f) * std::exp2(options.exposure.value_or(0.0f)),
              full = fullColor(converted(image, before), options) / factor;
  std::cout << "red is " << full << ", blue -" << full << "; --signed --scale " << 1 / full
            << " shows other images alike\n";
}

}  // namespace

Image converted(Image image, const ConvertOptions& options) {
  bool changed = false;
  if (!options.crop.empty()) {
    const std::vector<int>& c = options.crop;
    image = crop(image, {{c.at(0), c.at(2)}, {c.at(1), c.at(3)}});
  }
  if (options.scale || options.exposure) {
    const float factor = options.scale.value_or(1.0f) * std::exp2(options.exposure.value_or(0.0f));
    if (!std::isfinite(factor)) throw std::runtime_error("--scale and --exposure need a finite factor");
    scaleColors(image, factor);
    changed = true;
  }
  if (options.offset) {
    offsetColors(image, *options.offset);
    changed = true;
  }
  if (options.despike) {
    despike(image, *options.despike);
    changed = true;
  }
  if (options.bloomLevel) {
    BloomParams params = options.bloom;
    params.level = *options.bloomLevel;
    bloom(image, params);
    changed = true;
  }
  if (options.toneMap) {
    toneMap(image, options.maxLuminance);
    changed = true;
  }
  if (options.preserveColors) {
    preserveColors(image);
    changed = true;
  }
  if (options.isSigned) {
    image = signedColors(image, fullColor(image, options), options.zero);
    changed = true;
  }
  if (!options.resize.empty()) {
    const Point2i size = parseSize(options.resize);
    image = resize(image, size.x, size.y, options.resizeFilter);
    changed = true;
  }
  if (options.repeatPixels != 1) {
    image = repeatPixels(image, options.repeatPixels);
    changed = true;
  }
  if (options.flipY) {
    image = flipVertically(image);
    changed = true;
  }
  if (changed) {
    image.metadata.erase("samples");
    image.metadata.erase("seed");
  }
  return image;
}

int runConvert(const ConvertOptions& options) {
  requireWritable(options.output);
  try {
    Image image = loadLinear(options.input).image;
    if (!options.layer.empty()) image = layerAlone(options.input, image, options.layer);
    if (options.isSigned) tellScale(image, options);
    WriteOptions write = options.write;
    const auto layer = image.metadata.find("layer");
    if (layer != image.metadata.end() && isDataLayer(layer->second)) write.pixelType = PixelType::Float;
    writeImage(options.output, converted(std::move(image), options), write);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(options.input + ": " + e.what());
  }
  return 0;
}

}  // namespace pbrtmedia
