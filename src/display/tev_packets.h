// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/bounds.h"
#include "image/image.h"

// Packets of the image viewer tev (https://github.com/Tom94/tev), as programs send them to its port. All
// numbers are little endian. A packet is its length in bytes (uint32, itself included), its kind (uint8) and
// what the kind wants; texts end with a zero byte.
namespace pbrtmedia::tev {

enum class PacketKind : std::uint8_t { CloseImage = 2, CreateImage = 4, UpdateImage = 6 };  // 6: with strides

using Packet = std::vector<char>;

/// The viewer shows a black image of that name.
Packet createImage(std::string_view name, int width, int height, const std::vector<std::string>& channels);
/// The numbers of all channels of a tile, interleaved: `tile` in pixels of `image`, not empty.
Packet updateImage(std::string_view name, const Image& image, Bounds2i tile);
/// The viewer forgets the image; nothing happens when it knows none of that name.
Packet closeImage(std::string_view name);

}  // namespace pbrtmedia::tev
