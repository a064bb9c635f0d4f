// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "image/codecs.h"
#include "image/decode_error.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kHeaderBytes = 18;
constexpr std::size_t kMaxRun = 128;  // pixels in one run-length packet

enum class Kind { Palette = 1, TrueColour = 2, Mono = 3 };

/// The fixed part at the start of a TGA file (Truevision TGA specification 2.0, fields 1 to 5).
struct Header {
  std::size_t idLength, paletteFirst, paletteLength, paletteBits, width, height, bits, alphaBits;
  Kind kind;
  bool hasPalette, runLength, rightToLeft, topToBottom;
};

/// Bytes with an end that is checked.
class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}
  std::size_t left() const { return bytes_.size() - position_; }
  const std::byte* take(std::size_t count) {
    if (count > left()) failFile(name_, "TGA: the file ends early");
    const std::byte* at = bytes_.data() + position_;
    position_ += count;
    return at;
  }
  std::size_t byte() { return std::to_integer<std::size_t>(*take(1)); }
  std::size_t word() {
    const std::size_t low = byte();
    return low | (byte() << 8);
  }

 private:
  std::span<const std::byte> bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
};

/// A pixel as channel values in [0, 1]: grey in r for mono images.
struct Pixel {
  float r = 0, g = 0, b = 0, a = 1;
};

Pixel decodePixel(const std::byte* p, std::size_t bits, bool mono) {
  const auto value = [&](std::size_t i) { return static_cast<float>(std::to_integer<int>(p[i])) / 255.0f; };
  if (mono) return {value(0), value(0), value(0), bits == 16 ? value(1) : 1.0f};
  if (bits >= 24) return {value(2), value(1), value(0), bits == 32 ? value(3) : 1.0f};
  const unsigned packed = std::to_integer<unsigned>(p[0]) | (std::to_integer<unsigned>(p[1]) << 8);
  const auto five = [&](unsigned shift) { return static_cast<float>((packed >> shift) & 31u) / 31.0f; };
  return {five(10), five(5), five(0), (packed & 0x8000u) != 0 ? 1.0f : 0.0f};
}

bool isColourDepth(std::size_t bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; }

Header readHeader(Reader& in, const std::string& name) {
  Header h{};
  h.idLength = in.byte();
  const std::size_t paletteType = in.byte();
  const std::size_t type = in.byte();
  h.paletteFirst = in.word();
  h.paletteLength = in.word();
  h.paletteBits = in.byte();
  in.take(4);  // position on a screen
  h.width = in.word();
  h.height = in.word();
  h.bits = in.byte();
  const std::size_t descriptor = in.byte();
  h.alphaBits = descriptor & 15;
  h.rightToLeft = (descriptor & 16) != 0;
  h.topToBottom = (descriptor & 32) != 0;
  h.hasPalette = paletteType == 1;
  h.runLength = (type & 8) != 0;
  const std::size_t plainType = type & ~std::size_t{8};
  if (paletteType > 1 || plainType < 1 || plainType > 3) {
    failFile(name, "TGA: unknown image type " + std::to_string(type) + " with colour map type " +
                       std::to_string(paletteType));
  }
  h.kind = static_cast<Kind>(plainType);
  if (h.width == 0 || h.height == 0) failFile(name, "TGA: the image has no pixels");
  const bool fits = h.kind == Kind::TrueColour ? isColourDepth(h.bits) : (h.bits == 8 || h.bits == 16);
  if (!fits || (h.hasPalette && !isColourDepth(h.paletteBits))) {
    failFile(name, "TGA: unsupported depth of " + std::to_string(h.bits) + " bits per pixel");
  }
  if (h.kind == Kind::Palette && (!h.hasPalette || h.paletteLength == 0)) {
    failFile(name, "TGA: an image of palette indices without a palette");
  }
  return h;
}

std::vector<Pixel> readPalette(Reader& in, const Header& h) {
  std::vector<Pixel> palette;
  if (!h.hasPalette) return palette;
  const std::size_t entryBytes = (h.paletteBits + 7) / 8;
  const std::byte* entries = in.take(h.paletteLength * entryBytes);
  if (h.kind != Kind::Palette) return palette;  // allowed, and without meaning
  for (std::size_t i = 0; i < h.paletteLength; ++i) {
    palette.push_back(decodePixel(entries + i * entryBytes, h.paletteBits, false));
  }
  return palette;
}

/// The bytes of all pixels in file order, runs expanded.
std::vector<std::byte> readPixelBytes(Reader& in, const Header& h, const std::string& name) {
  const std::size_t pixelBytes = (h.bits + 7) / 8, pixels = h.width * h.height;
  // A packet of at most 128 pixels takes 1 + pixelBytes bytes: check before memory is taken.
  const std::size_t possible =
      h.runLength ? (in.left() / (1 + pixelBytes)) * kMaxRun : in.left() / pixelBytes;
  if (pixels > possible) {
    failFile(name, "TGA: " + std::to_string(h.width) + " x " + std::to_string(h.height) +
                       " pixels do not fit the " + std::to_string(in.left()) + " bytes that are left");
  }
  std::vector<std::byte> out;
  out.reserve(pixels * pixelBytes);
  if (!h.runLength) {
    const std::byte* data = in.take(pixels * pixelBytes);
    out.assign(data, data + pixels * pixelBytes);
    return out;
  }
  for (std::size_t done = 0; done < pixels;) {
    const std::size_t packet = in.byte(), count = (packet & 127) + 1;
    if (count > pixels - done) failFile(name, "TGA: a run goes past the last pixel");
    const bool repeated = (packet & 128) != 0;
    const std::byte* data = in.take(repeated ? pixelBytes : count * pixelBytes);
    for (std::size_t i = 0; i < count; ++i) {
      const std::byte* pixel = repeated ? data : data + i * pixelBytes;
      out.insert(out.end(), pixel, pixel + pixelBytes);
    }
    done += count;
  }
  return out;
}

}  // namespace

Image decodeTga(std::span<const std::byte> bytes, const std::string& name) {
  Reader in(bytes, name);
  if (bytes.size() < kHeaderBytes) failFile(name, "TGA: the file ends within its header");
  const Header h = readHeader(in, name);
  in.take(h.idLength);
  const std::vector<Pixel> palette = readPalette(in, h);
  const std::vector<std::byte> data = readPixelBytes(in, h, name);

  const bool mono = h.kind == Kind::Mono, alpha = h.alphaBits > 0;
  std::vector<std::string> channels =
      mono ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  if (alpha) channels.emplace_back("A");
  Image image(static_cast<int>(h.width), static_cast<int>(h.height), channels);
  const std::size_t pixelBytes = (h.bits + 7) / 8;
  for (std::size_t i = 0; i < h.width * h.height; ++i) {
    const std::byte* source = data.data() + i * pixelBytes;
    Pixel p;
    if (h.kind == Kind::Palette) {
      std::size_t entry = std::to_integer<std::size_t>(source[0]);
      if (pixelBytes == 2) entry |= std::to_integer<std::size_t>(source[1]) << 8;
      if (entry < h.paletteFirst || entry - h.paletteFirst >= palette.size()) {
        failFile(name, "TGA: pixel " + std::to_string(i) + " has palette index " + std::to_string(entry) +
                           ", outside of the palette");
      }
      p = palette[entry - h.paletteFirst];
    } else {
      p = decodePixel(source, h.bits, mono);
    }
    const std::size_t column = i % h.width, row = i / h.width;
    const std::size_t x = h.rightToLeft ? h.width - 1 - column : column;
    const std::size_t y = h.topToBottom ? row : h.height - 1 - row;
    float* out = image.data().data() + (y * h.width + x) * channels.size();
    *out++ = p.r;
    if (!mono) {
      *out++ = p.g;
      *out++ = p.b;
    }
    if (alpha) *out = p.a;
  }
  return image;
}

std::string encodeTga(const Image& image) {
  constexpr int kMaxSide = 65535;
  if (image.width() < 1 || image.height() < 1) throw std::runtime_error("an image without pixels");
  if (image.width() > kMaxSide || image.height() > kMaxSide) {
    throw std::runtime_error("TGA cannot hold sides above 65535 pixels");
  }
  if (!image.hasRgb()) throw std::runtime_error("TGA needs channels R, G, B or a grey one");
  std::string out(kHeaderBytes, '\0');
  const auto setWord = [&](std::size_t at, int v) {
    out[at] = static_cast<char>(v & 255);
    out[at + 1] = static_cast<char>(v >> 8);
  };
  out[2] = static_cast<char>(Kind::TrueColour);
  setWord(12, image.width());
  setWord(14, image.height());
  out[16] = 24;
  out[17] = 32;  // top row first, no alpha
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y);
      for (const float v : {c.b, c.g, c.r}) out += static_cast<char>(quantizeSrgb(v));
    }
  }
  return out;
}

}  // namespace pbrtmedia
