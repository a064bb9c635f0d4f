// SPDX-License-Identifier: BSD-2-Clause
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "image/codecs.h"
#include "image/decode_error.h"
#include "image/memory_limit.h"

// libpng reports errors by longjmp. Each function here that calls setjmp holds nothing with a destructor, and
// all memory lives in its callers.

namespace pbrtmedia {
namespace {

/// Deflate turns one byte into at most 1032; a header that claims more is a lie.
constexpr std::uint64_t kDeflateRatio = 1032;
constexpr std::size_t kMessageBytes = 200;
constexpr std::size_t kMaxKeyword = 79;  // of a text chunk

struct Source {
  const std::byte* data;
  std::size_t size, position;
};

void onError(png_structp png, png_const_charp message) {
  std::snprintf(static_cast<char*>(png_get_error_ptr(png)), kMessageBytes, "%s", message);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}  // e.g. unknown optional chunks: the pixels are whole

void onRead(png_structp png, png_bytep out, std::size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (count > source->size - source->position) png_error(png, "the file ends early");
  std::memcpy(out, source->data + source->position, count);
  source->position += count;
}

void onWrite(png_structp png, png_bytep data, std::size_t count) {
  auto* out = static_cast<std::string*>(png_get_io_ptr(png));
  bool stored = true;
  try {
    out->append(reinterpret_cast<const char*>(data), count);
  } catch (...) {
    stored = false;
  }
  if (!stored) png_error(png, "not enough memory");
}

void onFlush(png_structp) {}

class PngReader {
 public:
  explicit PngReader(std::span<const std::byte> bytes) : source_{bytes.data(), bytes.size(), 0} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, message_, onError, onWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source_, onRead);
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool readHeader() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_info(png_, info_);
    return true;
  }
  /// Palettes to colours, few bits to 8, transparent colours to alpha.
  bool expand() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_expand(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool readRows(png_bytep pixels, std::size_t rowBytes) {
    if (setjmp(png_jmpbuf(png_))) return false;
    for (int pass = 0; pass < passes_; ++pass) {
      for (png_uint_32 y = 0; y < height(); ++y) png_read_row(png_, pixels + y * rowBytes, nullptr);
    }
    png_read_end(png_, info_);
    return true;
  }

  png_uint_32 width() const { return png_get_image_width(png_, info_); }
  png_uint_32 height() const { return png_get_image_height(png_, info_); }
  std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
  int channels() const { return png_get_channels(png_, info_); }
  int bitDepth() const { return png_get_bit_depth(png_, info_); }
  std::map<std::string, std::string> texts() const {
    std::map<std::string, std::string> out;
    png_textp texts = nullptr;
    const int count = png_get_text(png_, info_, &texts, nullptr);
    for (int i = 0; i < count; ++i) out[texts[i].key] = texts[i].text != nullptr ? texts[i].text : "";
    return out;
  }
  std::string message() const { return std::string("PNG: ") + message_; }

 private:
  Source source_;
  char message_[kMessageBytes] = "";
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int passes_ = 1;
};

std::vector<std::string> channelNames(int count) {
  switch (count) {
    case 1:
      return {"Y"};
    case 2:
      return {"Y", "A"};
    case 3:
      return {"R", "G", "B"};
    default:
      return {"R", "G", "B", "A"};
  }
}

class PngWriter {
 public:
  PngWriter() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, message_, onError, onWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, &out_, onWrite, onFlush);
  }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }

  bool write(png_uint_32 width, png_uint_32 height, int colourType, png_bytepp rows, png_textp texts,
             int textCount) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(png_, info_, width, height, 8, colourType, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_RELATIVE);
    if (textCount > 0) png_set_text(png_, info_, texts, textCount);
    png_write_info(png_, info_);
    png_write_image(png_, rows);
    png_write_end(png_, info_);
    return true;
  }
  std::string take() { return std::move(out_); }
  std::string message() const { return std::string("PNG: ") + message_; }

 private:
  std::string out_;
  char message_[kMessageBytes] = "";
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

bool isAscii(const std::string& s) {
  return std::all_of(s.begin(), s.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// Text chunks that point into `metadata`, which must outlive them.
std::vector<png_text> makeTexts(const std::map<std::string, std::string>& metadata) {
  std::vector<png_text> texts;
  for (const auto& [key, value] : metadata) {
    if (key.empty() || key.size() > kMaxKeyword || !isAscii(key)) {
      throw std::runtime_error("a PNG text needs a name of 1 to 79 ASCII characters, found \"" + key + "\"");
    }
    png_text text{};
    text.compression = isAscii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(key.c_str());
    text.text = const_cast<char*>(value.c_str());
    text.text_length = value.size();
    texts.push_back(text);
  }
  return texts;
}

unsigned char quantizeLinear(float v) {
  const float scaled = 255.0f * v + 0.5f;
  if (!(scaled > 0)) return 0;
  return static_cast<unsigned char>(std::min(std::floor(scaled), 255.0f));
}

/// libpng takes memory for a chunk by its stated length before it reads it.
void requireChunksInside(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::size_t kSignature = 8, kAroundData = 12;  // length, type and checksum
  for (std::size_t at = kSignature; bytes.size() >= at + kAroundData;) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(bytes[at + i]);
    if (length > bytes.size() - at - kAroundData)
      failFile(name, "PNG: the file ends early, inside of a chunk");
    at += kAroundData + length;
  }
}

}  // namespace

Image decodePng(std::span<const std::byte> bytes, const std::string& name) {
  requireChunksInside(bytes, name);
  PngReader reader(bytes);
  if (!reader.readHeader()) failFile(name, reader.message());
  // Checked on the stored rows, before palettes and small depths are expanded.
  const std::uint64_t stored = std::uint64_t{reader.rowBytes()} * reader.height();
  if (stored > kDeflateRatio * bytes.size()) {
    failFile(name, "PNG: the header claims " + std::to_string(reader.width()) + " x " +
                       std::to_string(reader.height()) + " pixels, more than " +
                       std::to_string(bytes.size()) + " bytes can hold");
  }
  if (!reader.expand()) failFile(name, reader.message());
  const std::string excess =
      excessOf(reader.width(), reader.height(), static_cast<std::uint64_t>(reader.channels()), bytes.size());
  if (!excess.empty()) failFile(name, "PNG: " + excess);
  const std::size_t rowBytes = reader.rowBytes();
  // Not initialised: memory is taken as far as the file has data.
  const auto pixels = std::make_unique_for_overwrite<unsigned char[]>(rowBytes * reader.height());
  if (!reader.readRows(pixels.get(), rowBytes)) failFile(name, reader.message());

  Image image(static_cast<int>(reader.width()), static_cast<int>(reader.height()),
              channelNames(reader.channels()));
  std::vector<float>& out = image.data();
  if (reader.bitDepth() == 16) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = static_cast<float>((pixels[2 * i] << 8) | pixels[2 * i + 1]) / 65535.0f;
    }
  } else {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(pixels[i]) / 255.0f;
  }
  image.metadata = reader.texts();
  return image;
}

std::string encodePng(const Image& image) {
  if (image.width() < 1 || image.height() < 1) throw std::runtime_error("an image without pixels");
  if (!image.hasRgb()) throw std::runtime_error("PNG needs channels R, G, B or a grey one");
  const bool grey = !image.channelIndex("R") || image.channelCount() == 1;
  const auto alpha = image.channelIndex("A");
  const bool hasAlpha = alpha && image.channelCount() > 1;
  const std::size_t channels = (grey ? 1u : 3u) + (hasAlpha ? 1u : 0u);
  const int colourType = grey ? (hasAlpha ? PNG_COLOR_TYPE_GRAY_ALPHA : PNG_COLOR_TYPE_GRAY)
                              : (hasAlpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB);

  const std::size_t width = static_cast<std::size_t>(image.width()),
                    height = static_cast<std::size_t>(image.height());
  std::vector<unsigned char> pixels;
  pixels.reserve(width * height * channels);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y);
      pixels.push_back(quantizeSrgb(c.r));
      if (!grey) {
        pixels.push_back(quantizeSrgb(c.g));
        pixels.push_back(quantizeSrgb(c.b));
      }
      if (hasAlpha) pixels.push_back(quantizeLinear(image.at(x, y, *alpha)));
    }
  }
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < height; ++y) rows.push_back(pixels.data() + y * width * channels);
  std::vector<png_text> texts = makeTexts(image.metadata);
  PngWriter writer;
  if (!writer.write(static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), colourType,
                    rows.data(), texts.data(), static_cast<int>(texts.size()))) {
    throw std::runtime_error(writer.message());
  }
  return writer.take();
}

}  // namespace pbrtmedia
