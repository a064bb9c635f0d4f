// SPDX-License-Identifier: BSD-2-Clause
#include "image/image.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "base/files.h"
#include "image/codecs.h"

namespace pbrtmedia {
namespace {

std::size_t checkedCount(int width, int height, std::size_t channels) {
  if (width < 0 || height < 0) throw std::invalid_argument("an image cannot have a negative size");
  if (channels == 0) throw std::invalid_argument("an image needs at least one channel");
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > std::numeric_limits<std::ptrdiff_t>::max() / sizeof(float) / channels) {
    throw std::invalid_argument("an image of this size does not fit the address space");
  }
  return pixels * channels;
}

std::string lowerCaseExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

std::string encode(ImageFormat format, const Image& image, const WriteOptions& options) {
  switch (format) {
    case ImageFormat::Exr:
      return encodeExr(image, options);
    case ImageFormat::Png:
      return encodePng(image);
    case ImageFormat::Pfm:
      return encodePfm(image);
    case ImageFormat::Tga:
      return encodeTga(image);
  }
  throw std::logic_error("unknown image format");
}

}  // namespace

std::optional<ImageFormat> formatByExtension(const std::filesystem::path& path) {
  const std::string extension = lowerCaseExtension(path);
  if (extension == ".exr") return ImageFormat::Exr;
  if (extension == ".png") return ImageFormat::Png;
  if (extension == ".pfm") return ImageFormat::Pfm;
  if (extension == ".tga") return ImageFormat::Tga;
  return std::nullopt;
}

Image::Image(int width, int height, const std::vector<std::string>& channels)
    : Image(width, height, channels, std::vector<float>(checkedCount(width, height, channels.size()))) {}

Image::Image(int width, int height, std::vector<std::string> channels, std::vector<float> data)
    : dataWindow{{0, 0}, {width, height}},
      displayWindow{{0, 0}, {width, height}},
      width_(width),
      height_(height),
      channels_(std::move(channels)),
      data_(std::move(data)) {
  if (data_.size() != checkedCount(width, height, channels_.size())) {
    throw std::invalid_argument("an image of another size than its data");
  }
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (std::count(channels_.begin(), channels_.end(), channels_[i]) != 1) {
      throw std::invalid_argument("an image cannot have two channels \"" + channels_[i] + "\"");
    }
  }
  const auto r = channelIndex("R"), g = channelIndex("G"), b = channelIndex("B"), y = channelIndex("Y");
  if (r && g && b) {
    rgb_ = {*r, *g, *b};
  } else if (y) {
    rgb_ = {*y, *y, *y};
  } else if (channels_.size() == 1) {
    rgb_ = {0, 0, 0};
  }
}

std::optional<std::size_t> Image::channelIndex(std::string_view name) const {
  const auto found = std::find(channels_.begin(), channels_.end(), name);
  if (found == channels_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - channels_.begin());
}

Rgb Image::rgb(int x, int y) const {
  if (!rgb_) throw std::logic_error("this image has no channels R, G, B or Y");
  const float* pixel = data_.data() + index(x, y);
  return {pixel[(*rgb_)[0]], pixel[(*rgb_)[1]], pixel[(*rgb_)[2]]};
}

void Image::setRgb(int x, int y, Rgb v) {
  if (!rgb_) throw std::logic_error("this image has no channels R, G, B or Y");
  float* pixel = data_.data() + index(x, y);
  if ((*rgb_)[0] == (*rgb_)[1]) {
    pixel[(*rgb_)[0]] = v.isGrey() ? v.r : v.average();
    return;
  }
  for (std::size_t c = 0; c < 3; ++c) pixel[(*rgb_)[c]] = v[c];
}

Image readImage(const std::filesystem::path& path) {
  const FileBytes file = FileBytes::open(path);
  const std::string name = path.string();
  return decodeImage(detectFormat(file.bytes(), name), file.bytes(), name);
}

bool isWritableImageName(const std::filesystem::path& path) { return formatByExtension(path).has_value(); }

void writeImage(const std::filesystem::path& path, const Image& image, const WriteOptions& options) {
  const std::optional<ImageFormat> format = formatByExtension(path);
  if (!format) {
    throw std::runtime_error(path.string() + ": cannot write \"" + path.extension().string() +
                             "\" images; known: .exr, .pfm, .png, .tga");
  }
  std::string bytes;
  try {
    bytes = encode(*format, image, options);
  } catch (const std::exception& e) {
    throw std::runtime_error(path.string() + ": " + e.what());
  }
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw std::runtime_error(path.string() + ": cannot write the image's bytes");
  });
}

float encodeSrgb(float linear) {
  if (linear <= 0.0031308f) return 12.92f * linear;
  return static_cast<float>(1.055 * std::pow(static_cast<double>(linear), 1 / 2.4) - 0.055);
}

float decodeSrgb(float encoded) {
  if (encoded <= 0.04045f) return encoded / 12.92f;
  return static_cast<float>(std::pow((static_cast<double>(encoded) + 0.055) / 1.055, 2.4));
}

unsigned char quantizeSrgb(float linear) {
  const float scaled = 255.0f * encodeSrgb(linear) + 0.5f;
  if (!(scaled > 0)) return 0;
  return static_cast<unsigned char>(std::min(std::floor(scaled), 255.0f));
}

}  // namespace pbrtmedia
