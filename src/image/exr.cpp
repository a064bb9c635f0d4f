// SPDX-License-Identifier: BSD-2-Clause
#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "base/interruption.h"
#include "image/channels.h"
#include "image/codecs.h"
#include "image/decode_error.h"
#include "image/exr_header_check.h"
#include "image/exr_stream.h"

namespace pbrtmedia {
namespace {

Bounds2i toBounds(const Imath::Box2i& b) { return {{b.min.x, b.min.y}, {b.max.x + 1, b.max.y + 1}}; }

Imath::Box2i toBox(const Bounds2i& b) { return {{b.min.x, b.min.y}, {b.max.x - 1, b.max.y - 1}}; }

/// Where pixel (0, 0) of the picture would be in a buffer that starts at `window.min`. Computed as a number:
/// it is usually outside of the buffer.
char* originOf(const void* buffer, const Bounds2i& window, std::size_t pixelBytes) {
  const std::int64_t offset =
      (std::int64_t{window.min.y} * window.width() + window.min.x) * static_cast<std::int64_t>(pixelBytes);
  return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(buffer) -
                                 static_cast<std::uintptr_t>(offset));
}

/// R, G, B, then A, then the others by name.
std::vector<std::string> orderedChannels(const Imf::ChannelList& list) {
  std::vector<std::string> names, others;
  for (const char* name : {"R", "G", "B", "A"}) {
    if (list.findChannel(name) != nullptr) names.emplace_back(name);
  }
  for (auto c = list.begin(); c != list.end(); ++c) {
    if (std::find(names.begin(), names.end(), c.name()) == names.end()) others.emplace_back(c.name());
  }
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

void copyHeader(const Imf::Header& header, Image& image) {
  image.dataWindow = toBounds(header.dataWindow());
  image.displayWindow = toBounds(header.displayWindow());
  for (auto a = header.begin(); a != header.end(); ++a) {
    const std::string name = a.name();
    if (name == "type" || name == "name") continue;  // belong to the part, not to the picture
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) {
      image.metadata[name] = text->value();
    }
  }
}

/// Rows to read at once: some 16 MB, in whole blocks of lines of every method of compression.
std::int64_t rowsPerStep(std::size_t rowBytes) {
  constexpr std::size_t kBytes = std::size_t{16} << 20, kBlock = 256;
  return static_cast<std::int64_t>((kBytes / rowBytes / kBlock + 1) * kBlock);
}

Image readChannels(Imf::InputFile& file) {
  const Imf::Header& header = file.header();
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
      throw std::runtime_error(std::string("channel \"") + c.name() + "\" is subsampled");
    }
  }
  const Bounds2i window = toBounds(header.dataWindow());
  const std::vector<std::string> channels = orderedChannels(header.channels());
  const std::size_t pixelBytes = channels.size() * sizeof(float);
  const std::size_t rowFloats = channels.size() * static_cast<std::size_t>(window.width());
  std::vector<float> data;
  data.reserve(rowFloats * static_cast<std::size_t>(window.height()));
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    char* base = originOf(data.data() + c, window, pixelBytes);
    frame.insert(channels[c], Imf::Slice(Imf::FLOAT, base, pixelBytes, rowFloats * sizeof(float)));
  }
  file.setFrameBuffer(frame);
  // In steps: memory is taken as far as the file has data.
  const std::int64_t rows = rowsPerStep(rowFloats * sizeof(float));
  for (std::int64_t y = window.min.y; y < window.max.y; y += rows) {
    leaveIfStopped();
    const auto end = static_cast<int>(std::min<std::int64_t>(y + rows, window.max.y));
    data.resize(rowFloats * static_cast<std::size_t>(end - window.min.y));
    file.readPixels(static_cast<int>(y), end - 1);
  }
  Image image(window.width(), window.height(), channels, std::move(data));
  copyHeader(header, image);
  return image;
}

/// Luminance and subsampled chroma: OpenEXR's own conversion knows the reconstruction filter.
Image readLuminanceChroma(std::span<const std::byte> bytes, const std::string& name) {
  ExrMemoryInput stream(bytes, name);
  Imf::RgbaInputFile file(stream);
  const Bounds2i window = toBounds(file.dataWindow());
  const bool hasAlpha = file.header().channels().findChannel("A") != nullptr;
  Image image(
      window.width(), window.height(),
      hasAlpha ? std::vector<std::string>{"R", "G", "B", "A"} : std::vector<std::string>{"R", "G", "B"});
  std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(window.area()));
  char* base = originOf(pixels.data(), window, sizeof(Imf::Rgba));
  file.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(base), 1, static_cast<std::size_t>(window.width()));
  file.readPixels(window.min.y, window.max.y - 1);
  float* out = image.data().data();
  for (const Imf::Rgba& p : pixels) {
    *out++ = p.r;
    *out++ = p.g;
    *out++ = p.b;
    if (hasAlpha) *out++ = p.a;
  }
  copyHeader(file.header(), image);
  return image;
}

Imf::Compression toImf(ExrCompression c) {
  switch (c) {
    case ExrCompression::None:
      return Imf::NO_COMPRESSION;
    case ExrCompression::Zip:
      return Imf::ZIP_COMPRESSION;
    case ExrCompression::Piz:
      return Imf::PIZ_COMPRESSION;
  }
  throw std::logic_error("unknown compression");
}

Imf::PixelType storedType(const std::string& channel, const WriteOptions& options) {
  return options.pixelType == PixelType::Half && isColour(channel) ? Imf::HALF : Imf::FLOAT;
}

Imf::Header makeHeader(const Image& image, const WriteOptions& options) {
  Imf::Header header(toBox(image.displayWindow), toBox(image.dataWindow), 1, Imath::V2f(0, 0), 1,
                     Imf::INCREASING_Y, toImf(options.compression));
  for (const auto& [key, value] : image.metadata) {
    if (key.empty() || key.size() > 255) {
      throw std::runtime_error("an EXR attribute needs a name of 1 to 255 bytes, found \"" + key + "\"");
    }
    header.insert(key, Imf::StringAttribute(value));
  }
  for (const std::string& name : image.channels())
    header.channels().insert(name, Imf::Channel(storedType(name, options)));
  return header;
}

std::string encodeChecked(const Image& image, const WriteOptions& options) {
  if (image.width() < 1 || image.height() < 1) throw std::runtime_error("an image without pixels");
  if (image.dataWindow.width() != image.width() || image.dataWindow.height() != image.height()) {
    throw std::runtime_error("the data window does not have the size of the image");
  }
  const bool anyHalf = options.pixelType == PixelType::Half;
  std::vector<half> halves;
  if (anyHalf) halves.assign(image.data().begin(), image.data().end());
  const auto sliceOf = [&](std::size_t c, Imf::PixelType type) {
    const bool isHalf = type == Imf::HALF;
    const void* pixels = isHalf ? static_cast<const void*>(halves.data()) : image.data().data();
    const std::size_t valueBytes = isHalf ? sizeof(half) : sizeof(float);
    const std::size_t pixelBytes = image.channelCount() * valueBytes;
    return Imf::Slice(type, originOf(pixels, image.dataWindow, pixelBytes) + c * valueBytes, pixelBytes,
                      pixelBytes * static_cast<std::size_t>(image.width()));
  };

  ExrMemoryOutput stream;
  {
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < image.channelCount(); ++c)
      frame.insert(image.channels()[c], sliceOf(c, storedType(image.channels()[c], options)));
    Imf::OutputFile file(stream, makeHeader(image, options));
    file.setFrameBuffer(frame);
    file.writePixels(image.height());
  }
  return stream.take();
}

}  // namespace

Image decodeExr(std::span<const std::byte> bytes, const std::string& name) {
  try {
    checkExrHeaders(bytes);
    ExrMemoryInput stream(bytes, name);
    Imf::InputFile file(stream);
    const Imf::ChannelList& channels = file.header().channels();
    if (channels.findChannel("RY") != nullptr || channels.findChannel("BY") != nullptr) {
      return readLuminanceChroma(bytes, name);
    }
    return readChannels(file);
  } catch (const std::bad_alloc&) {
    failFile(name, "OpenEXR: not enough memory for this image");
  } catch (const std::exception& e) {
    failFile(name, std::string("OpenEXR: ") + e.what());
  }
}

std::string encodeExr(const Image& image, const WriteOptions& options) {
  try {
    return encodeChecked(image, options);
  } catch (const Iex::BaseExc& e) {  // not a runtime_error
    throw std::runtime_error(std::string("OpenEXR: ") + e.what());
  }
}

}  // namespace pbrtmedia
