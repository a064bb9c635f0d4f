// SPDX-License-Identifier: BSD-2-Clause
#include "image/storage.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "image/exr_stream.h"

namespace pbrtmedia {
namespace {

std::string nameOf(Imf::PixelType type) {
  return type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
}

std::string nameOf(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
      return "none";
    case Imf::RLE_COMPRESSION:
      return "rle";
    case Imf::ZIPS_COMPRESSION:
      return "zips";
    case Imf::ZIP_COMPRESSION:
      return "zip";
    case Imf::PIZ_COMPRESSION:
      return "piz";
    case Imf::PXR24_COMPRESSION:
      return "pxr24";
    case Imf::B44_COMPRESSION:
      return "b44";
    case Imf::B44A_COMPRESSION:
      return "b44a";
    case Imf::DWAA_COMPRESSION:
      return "dwaa";
    case Imf::DWAB_COMPRESSION:
      return "dwab";
    default:
      return "unknown";
  }
}

ImageStorage storageOfExr(std::span<const std::byte> bytes, const std::string& name) {
  ExrMemoryInput stream(bytes, name);
  const Imf::InputFile file(stream);
  const Imf::ChannelList& channels = file.header().channels();
  std::vector<std::pair<std::string, std::string>> types;
  for (auto c = channels.begin(); c != channels.end(); ++c)
    types.emplace_back(c.name(), nameOf(c.channel().type));
  ImageStorage storage{"", nameOf(file.header().compression())};
  const bool isOne = std::all_of(types.begin(), types.end(),
                                 [&](const auto& one) { return one.second == types.front().second; });
  if (isOne && !types.empty()) {
    storage.pixelType = types.front().second;
    return storage;
  }
  for (const auto& [channel, type] : types) {
    if (!storage.pixelType.empty()) storage.pixelType += ", ";
    storage.pixelType += channel;
    storage.pixelType += ' ';
    storage.pixelType += type;
  }
  return storage;
}

std::string bits(std::byte count) { return std::to_string(std::to_integer<int>(count)) + " bits"; }

}  // namespace

ImageStorage storageOf(ImageFormat format, std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::size_t kPngDepth = 24, kTgaType = 2, kTgaDepth = 16;
  switch (format) {
    case ImageFormat::Exr:
      return storageOfExr(bytes, name);
    case ImageFormat::Png:
      return {bits(bytes[kPngDepth]), "deflate"};
    case ImageFormat::Tga: {
      constexpr int kRunLength = 8;
      const bool isPacked = (std::to_integer<int>(bytes[kTgaType]) & kRunLength) != 0;
      return {bits(bytes[kTgaDepth]), isPacked ? "rle" : "none"};
    }
    case ImageFormat::Pfm:
      break;
  }
  return {"float", "none"};
}

}  // namespace pbrtmedia
