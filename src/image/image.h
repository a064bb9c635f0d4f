// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bounds.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A float image of named channels, interleaved, top row first. RGB images have channels "R", "G", "B".
class Image {
 public:
  Image() = default;
  /// Black; both windows are (0, 0) - (width, height). Throws std::invalid_argument for a negative size, no
  /// channels, or a repeated channel name.
  Image(int width, int height, const std::vector<std::string>& channels = {"R", "G", "B"});
  /// The same with its numbers, width * height * channels of them; std::invalid_argument for another count.
  Image(int width, int height, std::vector<std::string> channels, std::vector<float> data);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t channelCount() const { return channels_.size(); }
  const std::vector<std::string>& channels() const { return channels_; }
  float& at(int x, int y, std::size_t c) { return data_[index(x, y) + c]; }
  float at(int x, int y, std::size_t c) const { return data_[index(x, y) + c]; }
  std::optional<std::size_t> channelIndex(std::string_view name) const;
  /// Whether pixels have a colour: channels R, G and B, or a grey one ("Y", or the only channel there is).
  bool hasRgb() const { return rgb_.has_value(); }
  /// The colour of a pixel; a grey one has three equal channels. Throws std::logic_error without `hasRgb`.
  Rgb rgb(int x, int y) const;
  /// Sets R, G and B, or the grey channel to the average. Throws std::logic_error without `hasRgb`.
  void setRgb(int x, int y, Rgb v);
  std::vector<float>& data() { return data_; }
  const std::vector<float>& data() const { return data_; }

  /// Where the pixels lie in the whole picture (EXR data and display windows); equal when not cropped.
  Bounds2i dataWindow, displayWindow;
  /// Header attributes (EXR strings): command, seed, samples, seconds, scene hash, ...
  std::map<std::string, std::string> metadata;

 private:
  std::size_t index(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
           channels_.size();
  }
  int width_ = 0, height_ = 0;
  std::vector<std::string> channels_;
  std::optional<std::array<std::size_t, 3>> rgb_;  ///< channels that hold R, G and B
  std::vector<float> data_;
};

enum class PixelType { Half, Float };
enum class ExrCompression { None, Zip, Piz };

struct WriteOptions {
  PixelType pixelType = PixelType::Half;  ///< EXR only; of colours: data stay float (isColour)
  ExrCompression compression = ExrCompression::Zip;
};

/// Reads .exr .png .pfm .tga (codecs.h), chosen by the file's first bytes (TGA by its name). PNG and TGA
/// values are divided by 255 (or 65535), not linearised. Throws SceneError (location: the file) for anything
/// unreadable, truncated or unreasonable; sizes in the header are checked against the data before memory is
/// taken.
Image readImage(const std::filesystem::path& path);
/// True when the extension of `path` names a format that `writeImage` can write.
bool isWritableImageName(const std::filesystem::path& path);
/// Writes by extension, atomically. 8-bit formats are sRGB-encoded: floor(clamp(255 e(v) + 1/2, 0, 255)).
/// Throws std::runtime_error naming path and reason.
void writeImage(const std::filesystem::path& path, const Image& image, const WriteOptions& options = {});

/// sRGB transfer curve and its inverse.
float encodeSrgb(float linear);
float decodeSrgb(float encoded);

}  // namespace pbrtmedia
