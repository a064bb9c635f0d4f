// SPDX-License-Identifier: BSD-2-Clause
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "image/codecs.h"
#include "image/decode_error.h"

namespace pbrtmedia {
namespace {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// The words of the header, one after the other.
class HeaderReader {
 public:
  explicit HeaderReader(std::string_view text) : text_(text) {}
  std::string_view word() {
    while (position_ < text_.size() && isBlank(text_[position_])) ++position_;
    const std::size_t start = position_;
    while (position_ < text_.size() && !isBlank(text_[position_])) ++position_;
    return text_.substr(start, position_ - start);
  }
  /// What follows the single blank after the last word; nothing when that is missing.
  std::optional<std::string_view> rest() const {
    if (position_ >= text_.size()) return std::nullopt;
    return text_.substr(position_ + 1);
  }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
};

template <class T>
std::optional<T> parse(std::string_view word) {
  T value{};
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

float loadFloat(const char* from, bool swap) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, from, sizeof bits);
  if (swap) bits = (bits >> 24) | ((bits >> 8) & 0xff00u) | ((bits << 8) & 0xff0000u) | (bits << 24);
  return std::bit_cast<float>(bits);
}

}  // namespace

Image decodePfm(std::span<const std::byte> bytes, const std::string& name) {
  HeaderReader header(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  const std::string_view magic = header.word();
  if (magic != "PF" && magic != "Pf") failFile(name, "PFM: the file does not start with \"PF\" or \"Pf\"");
  const std::size_t channels = magic == "PF" ? 3 : 1;
  const std::optional<int> width = parse<int>(header.word()), height = parse<int>(header.word());
  if (!width || !height || *width < 1 || *height < 1)
    failFile(name, "PFM: expected a width and height above 0");
  const std::optional<float> scale = parse<float>(header.word());
  if (!scale || *scale == 0 || !std::isfinite(*scale)) {
    failFile(name, "PFM: expected a finite scale other than 0 after the size");
  }
  const std::string_view data = header.rest().value_or(std::string_view());
  const std::size_t w = static_cast<std::size_t>(*width), h = static_cast<std::size_t>(*height);
  if (w * h > data.size() / (channels * sizeof(float))) {
    failFile(name, "PFM: " + std::to_string(w) + " x " + std::to_string(h) + " pixels need more than the " +
                       std::to_string(data.size()) + " bytes after the header");
  }
  const bool littleEndian = *scale < 0;
  const bool swap = littleEndian != (std::endian::native == std::endian::little);
  const float factor = std::abs(*scale);
  Image image(*width, *height,
              channels == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"});
  const std::size_t rowValues = w * channels;
  for (std::size_t y = 0; y < h; ++y) {
    const char* row = data.data() + (h - 1 - y) * rowValues * sizeof(float);  // bottom row first
    float* out = image.data().data() + y * rowValues;
    for (std::size_t i = 0; i < rowValues; ++i) out[i] = factor * loadFloat(row + i * sizeof(float), swap);
  }
  return image;
}

std::string encodePfm(const Image& image) {
  if (image.width() < 1 || image.height() < 1) throw std::runtime_error("an image without pixels");
  if (!image.hasRgb()) throw std::runtime_error("PFM needs channels R, G, B or a grey one");
  const bool grey = !image.channelIndex("R") || image.channelCount() == 1;
  std::ostringstream header;
  header << (grey ? "Pf" : "PF") << '\n' << image.width() << ' ' << image.height() << "\n-1.0\n";
  std::string out = header.str();
  const auto store = [&](float v) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(v);
    for (unsigned i = 0; i < 4; ++i) out += static_cast<char>((bits >> (8 * i)) & 0xffu);
  };
  for (int y = image.height() - 1; y >= 0; --y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y);
      store(c.r);
      if (grey) continue;
      store(c.g);
      store(c.b);
    }
  }
  return out;
}

}  // namespace pbrtmedia
