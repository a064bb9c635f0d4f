// SPDX-License-Identifier: BSD-2-Clause
#include "image/exr_header_check.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "image/exr_attribute_check.h"
#include "image/exr_stream.h"
#include "image/memory_limit.h"

namespace pbrtmedia {
namespace {

/// Longest side of an image, pixels.
constexpr std::int64_t kMaxSide = std::int64_t{1} << 18;
/// Unpacked bytes that are always allowed, so that tiny files need no argument.
constexpr std::uint64_t kFreeBytes = std::uint64_t{1} << 22;

/// What one stored byte can become at most: the limit of the method, rounded up.
std::uint64_t largestRatio(Imf::Compression c) {
  switch (c) {
    case Imf::NO_COMPRESSION:
      return 1;
    case Imf::RLE_COMPRESSION:
      return 128;  // runs of at most 128 bytes in 2
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
      return 16;  // 32 bytes in at least 3
    case Imf::ZIPS_COMPRESSION:
    case Imf::ZIP_COMPRESSION:  // deflate: 1032
    case Imf::PXR24_COMPRESSION:
    case Imf::PIZ_COMPRESSION:
      return 2048;
    default:
      return std::uint64_t{1} << 17;  // DWA: deflate over one number per 8 x 8 block
  }
}

std::uint64_t bytesPerPixel(const Imf::Header& header) {
  std::uint64_t bytes = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    bytes += c.channel().type == Imf::HALF ? 2 : 4;
  }
  return bytes;
}

void checkHeader(const Imf::Header& header, std::uint64_t fileSize) {
  header.sanityCheck(header.hasTileDescription());
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    throw std::runtime_error("the header claims " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels; sides may have 1 to " + std::to_string(kMaxSide));
  }
  const std::uint64_t perPixel = bytesPerPixel(header);
  if (perPixel == 0) throw std::runtime_error("the image has no channels");
  const std::uint64_t budget = fileSize * largestRatio(header.compression()) + kFreeBytes;
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > budget / perPixel) {
    throw std::runtime_error("the header claims " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels, more than " + std::to_string(fileSize) + " bytes can hold");
  }
  std::uint64_t channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
  const std::string excess =
      excessOf(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), channels, fileSize);
  if (!excess.empty()) throw std::runtime_error(excess);
  if (!header.hasTileDescription()) return;
  const Imf::TileDescription& tiles = header.tileDescription();
  const std::uint64_t tilePixels = std::uint64_t{tiles.xSize} * tiles.ySize;
  // A tile is unpacked whole, however little of it the image covers.
  if (tilePixels == 0 || tilePixels > budget / perPixel ||
      tilePixels > mostImageMemory(fileSize) / (channels * sizeof(float))) {
    throw std::runtime_error("the tiles are too large: " + std::to_string(tiles.xSize) + " x " +
                             std::to_string(tiles.ySize) + " pixels");
  }
  const auto count = [](std::int64_t side, std::uint64_t tile) {
    return (static_cast<std::uint64_t>(side) + tile - 1) / tile;
  };
  if (count(width, tiles.xSize) * count(height, tiles.ySize) > fileSize / sizeof(std::uint64_t)) {
    throw std::runtime_error("the table of tiles does not fit the file");
  }
}

}  // namespace

void checkExrHeaders(std::span<const std::byte> bytes) {
  constexpr std::size_t kFirstHeader = 8;  // after magic number and version
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.size() < kFirstHeader || !text.starts_with("\x76\x2f\x31\x01")) {
    throw std::runtime_error("not an OpenEXR file");
  }
  int version = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    version |= static_cast<int>(static_cast<unsigned char>(text[4 + i])) << (8 * i);
  }
  if (version & Imf::NON_IMAGE_FLAG) throw std::runtime_error("deep images are not supported");
  const bool multiPart = (version & Imf::MULTI_PART_FILE_FLAG) != 0;
  std::size_t position = kFirstHeader;
  do {
    const std::size_t end = skipExrHeader(text, position);
    ExrMemoryInput stream(bytes, "header");
    stream.seekg(position);
    Imf::Header header;
    header.readFrom(stream, version);
    checkHeader(header, bytes.size());
    if (header.hasChunkCount() &&
        (header.chunkCount() < 0 || static_cast<std::size_t>(header.chunkCount()) > bytes.size() / 8)) {
      throw std::runtime_error("the table of chunks does not fit the file");
    }
    position = end;
  } while (multiPart && position < text.size() && text[position] != '\0');
}

}  // namespace pbrtmedia
