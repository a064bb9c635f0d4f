// SPDX-License-Identifier: BSD-2-Clause
#include "image/channels.h"

#include <stdexcept>

namespace pbrtmedia {

Image withChannels(const Image& image, const std::vector<std::string>& names,
                   const std::vector<std::string>& room) {
  std::vector<std::string> all = names;
  all.insert(all.end(), room.begin(), room.end());
  Image out(image.width(), image.height(), all);
  out.dataWindow = image.dataWindow;
  out.displayWindow = image.displayWindow;
  out.metadata = image.metadata;
  for (std::size_t to = 0; to < names.size(); ++to) {
    const std::size_t from = image.channelIndex(names[to]).value();
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) out.at(x, y, to) = image.at(x, y, from);
    }
  }
  return out;
}

void requireColor(const Image& image) {
  if (!image.hasRgb()) throw std::invalid_argument("the image has no channels R, G, B or Y");
}

bool isColour(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  const std::string_view last = dot == std::string_view::npos ? channel : channel.substr(dot + 1);
  const bool isData = channel.starts_with("variance.") || channel.starts_with("sums.");
  // "P.Y" is a coordinate.
  return !isData && (last == "R" || last == "G" || last == "B" || last == "A" || channel == "Y");
}

}  // namespace pbrtmedia
