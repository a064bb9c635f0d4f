// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/info.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "image/channels.h"
#include "tools/imgtool/layers.h"

namespace pbrtmedia {
namespace {

using nlohmann::json;

json toJson(const Bounds2i& b) { return {b.min.x, b.min.y, b.max.x, b.max.y}; }

json infoJson(const std::string& file, const LoadedImage& loaded) {
  const Image& image = loaded.image;
  json out;
  out["file"] = file;
  out["format"] = formatName(loaded.format);
  out["pixelType"] = loaded.stored.pixelType;
  out["compression"] = loaded.stored.compression;
  out["linearised"] = isSrgbEncoded(loaded.format);
  out["width"] = image.width();
  out["height"] = image.height();
  out["dataWindow"] = toJson(image.dataWindow);
  out["displayWindow"] = toJson(image.displayWindow);
  out["metadata"] = image.metadata;
  out["channels"] = json::array();
  for (const ChannelStatistics& s : channelStatistics(image)) {
    out["channels"].push_back({{"name", s.name},
                               {"nan", s.nans},
                               {"inf", s.infinities},
                               {"min", s.min},
                               {"max", s.max},
                               {"mean", s.mean}});
  }
  if (image.hasRgb()) out["logAverageLuminance"] = logAverageLuminance(image);
  return out;
}

/// Later lines of a value stand under its first.
std::string indented(const std::string& value) {
  std::string text;
  for (const char c : value) text += c == '\n' ? std::string("\n    ") : std::string(1, c);
  return text;
}

void printInfo(const std::string& file, const LoadedImage& loaded) {
  const Image& image = loaded.image;
  std::cout << file << ": " << formatName(loaded.format) << ", " << image.width() << " x " << image.height()
            << " pixels, " << loaded.stored.pixelType << ", compression " << loaded.stored.compression
            << (isSrgbEncoded(loaded.format) ? ", values linearised from sRGB" : "") << '\n'
            << "  data window     " << toString(image.dataWindow) << '\n'
            << "  display window  " << toString(image.displayWindow) << '\n';
  if (image.hasRgb()) std::cout << "  log-average luminance  " << logAverageLuminance(image) << '\n';
  for (const ChannelStatistics& s : channelStatistics(image)) {
    std::cout << "  channel " << std::left << std::setw(8) << s.name << std::right << "  min " << s.min
              << "  max " << s.max << "  mean " << s.mean << "  NaN " << s.nans << "  inf " << s.infinities
              << '\n';
  }
  for (const auto& [key, value] : image.metadata) std::cout << "  " << key << ": " << indented(value) << '\n';
}

}  // namespace

std::vector<ChannelStatistics> channelStatistics(const Image& image) {
  std::vector<ChannelStatistics> all;
  for (std::size_t c = 0; c < image.channelCount(); ++c) {
    ChannelStatistics s;
    s.name = image.channels()[c];
    double sum = 0;
    std::int64_t finite = 0;
    float lowest = std::numeric_limits<float>::max(), highest = std::numeric_limits<float>::lowest();
    for (std::size_t i = c; i < image.data().size(); i += image.channelCount()) {
      const float v = image.data()[i];
      if (std::isnan(v)) {
        ++s.nans;
      } else if (std::isinf(v)) {
        ++s.infinities;
      } else {
        ++finite;
        sum += static_cast<double>(v);
        lowest = std::min(lowest, v);
        highest = std::max(highest, v);
      }
    }
    if (finite > 0) {
      s.min = static_cast<double>(lowest);
      s.max = static_cast<double>(highest);
      s.mean = sum / static_cast<double>(finite);
    }
    all.push_back(s);
  }
  return all;
}

double logAverageLuminance(const Image& image) {
  constexpr double kOffset = 1e-6;  // keeps black pixels from making the average 0
  double sum = 0;
  std::int64_t count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float luminance = image.rgb(x, y).luminance();
      if (!std::isfinite(luminance)) continue;
      sum += std::log(kOffset + std::max(0.0, static_cast<double>(luminance)));
      ++count;
    }
  }
  return count > 0 ? std::exp(sum / static_cast<double>(count)) : 0;
}

int runInfo(const InfoOptions& options) {
  json all = json::array();
  for (const std::string& file : options.files) {
    LoadedImage loaded = loadLinear(file);
    if (!options.layer.empty())
      loaded.image = withChannels(loaded.image, channelsOfLayer(file, loaded.image, options.layer));
    if (options.json) {
      all.push_back(infoJson(file, loaded));
    } else {
      printInfo(file, loaded);
    }
  }
  if (options.json) std::cout << all.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
  return 0;
}

}  // namespace pbrtmedia
