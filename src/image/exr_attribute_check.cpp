// SPDX-License-Identifier: BSD-2-Clause
#include "image/exr_attribute_check.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace pbrtmedia {
namespace {

constexpr std::size_t kMaxName = 255;  // bytes of an attribute or type name

[[noreturn]] void failCutOff() { throw std::runtime_error("the header is cut off"); }

std::uint32_t littleEndian(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < 4) failCutOff();
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return value;
}

/// The text up to the next zero byte.
std::string_view nameAt(std::string_view bytes, std::size_t at) {
  const std::size_t zero = bytes.find('\0', at);
  if (zero == std::string_view::npos || zero - at > kMaxName) failCutOff();
  return bytes.substr(at, zero - at);
}

struct FixedType {
  std::string_view name;
  std::size_t size;  ///< bytes
};

constexpr FixedType kFixedTypes[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};

/// Channels: names, each with 16 bytes, and an empty name.
bool isChannelList(std::string_view value) {
  std::size_t at = 0;
  for (;;) {
    const std::string_view name = nameAt(value, at);
    at += name.size() + 1;
    if (name.empty()) return at == value.size();
    at += 16;
    if (at >= value.size()) return false;
  }
}

/// Strings, each after its length.
bool isStringVector(std::string_view value) {
  std::size_t at = 0;
  while (at < value.size()) {
    const std::uint32_t length = littleEndian(value, at);
    at += 4;
    if (length > value.size() - at) return false;
    at += length;
  }
  return true;
}

bool isPreview(std::string_view value) {
  const std::uint64_t width = littleEndian(value, 0), height = littleEndian(value, 4);
  return width < (1u << 16) && height < (1u << 16) && value.size() == 8 + 4 * width * height;
}

bool sizeFitsType(std::string_view type, std::string_view value) {
  for (const FixedType& fixed : kFixedTypes) {
    if (type == fixed.name) return value.size() == fixed.size;
  }
  if (type == "chlist") return isChannelList(value);
  if (type == "stringvector") return isStringVector(value);
  if (type == "floatvector") return value.size() % 4 == 0;
  if (type == "preview") return isPreview(value);
  // A compressed list of object names: it states its unpacked size, and no image of ours needs it.
  if (type == "idmanifest") throw std::runtime_error("attributes of type \"idmanifest\" are not supported");
  return true;  // text and unknown types take all of their bytes
}

}  // namespace

std::size_t skipExrHeader(std::string_view file, std::size_t position) {
  for (;;) {
    const std::string_view name = nameAt(file, position);
    position += name.size() + 1;
    if (name.empty()) return position;
    const std::string_view type = nameAt(file, position);
    position += type.size() + 1;
    const std::uint32_t size = littleEndian(file, position);
    position += 4;
    if (size > file.size() - position) {
      throw std::runtime_error("the header has an attribute longer than the file");
    }
    if (!sizeFitsType(type, file.substr(position, size))) {
      throw std::runtime_error("the header has an attribute \"" + std::string(name) +
                               "\" whose size does not fit its type \"" + std::string(type) + "\"");
    }
    position += size;
  }
}

}  // namespace pbrtmedia
