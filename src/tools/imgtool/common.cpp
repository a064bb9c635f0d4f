// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/common.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "base/files.h"
#include "base/writable.h"

namespace pbrtmedia {
namespace {

void linearise(Image& image) {
  for (std::size_t c = 0; c < image.channelCount(); ++c) {
    if (image.channels()[c] == "A") continue;  // coverage is stored linearly
    for (std::size_t i = c; i < image.data().size(); i += image.channelCount()) {
      image.data()[i] = decodeSrgb(image.data()[i]);
    }
  }
}

}  // namespace

LoadedImage loadLinear(const std::filesystem::path& path) {
  const FileBytes file = FileBytes::open(path);
  const std::string name = path.string();
  const ImageFormat format = detectFormat(file.bytes(), name);
  LoadedImage loaded{decodeImage(format, file.bytes(), name), format, storageOf(format, file.bytes(), name)};
  if (isSrgbEncoded(format)) linearise(loaded.image);
  return loaded;
}

std::string eachOf(const std::vector<const Image*>& images, const std::string& key) {
  std::vector<std::string> lines;
  for (const Image* image : images) {
    const auto found = image->metadata.find(key);
    std::istringstream in(found == image->metadata.end() ? std::string() : found->second);
    for (std::string line; std::getline(in, line);) {
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

void requireWritable(const std::filesystem::path& path) {
  if (!isWritableImageName(path))
    throw std::runtime_error(path.string() + ": unknown image extension; known: .exr, .pfm, .png, .tga");
  checkWritable(path);
}

std::string toString(const Bounds2i& b) {
  std::ostringstream out;
  out << '(' << b.min.x << ", " << b.min.y << ") - (" << b.max.x << ", " << b.max.y << ')';
  return out.str();
}

std::string shortest(float v) {
  char text[64];
  const auto [end, status] = std::to_chars(text, text + sizeof text, v);
  return status == std::errc() ? std::string(text, end) : std::string("?");
}

}  // namespace pbrtmedia
