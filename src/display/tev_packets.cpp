// SPDX-License-Identifier: BSD-2-Clause
#include "display/tev_packets.h"

#include <bit>
#include <concepts>
#include <cstring>

namespace pbrtmedia::tev {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

class Writer {
 public:
  explicit Writer(PacketKind kind) : bytes_(sizeof(std::uint32_t)) {
    number(static_cast<std::uint8_t>(kind));
  }

  template <std::integral T>
  void number(T value) {
    append(&value, sizeof value);
  }
  void flag(bool value) { number(static_cast<std::uint8_t>(value ? 1 : 0)); }
  void text(std::string_view value) {
    append(value.data(), value.size());
    bytes_.push_back('\0');
  }
  void floats(const float* values, std::size_t count) { append(values, count * sizeof(float)); }
  void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }

  Packet finish() {
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &length, sizeof length);
    return std::move(bytes_);
  }

 private:
  void append(const void* data, std::size_t size) {
    const auto* const begin = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }

  Packet bytes_;
};

}  // namespace

Packet createImage(std::string_view name, int width, int height, const std::vector<std::string>& channels) {
  Writer packet(PacketKind::CreateImage);
  packet.flag(false);  // a render that goes on in the background takes no focus
  packet.text(name);
  packet.number(static_cast<std::int32_t>(width));
  packet.number(static_cast<std::int32_t>(height));
  packet.number(static_cast<std::int32_t>(channels.size()));
  for (const std::string& channel : channels) packet.text(channel);
  return packet.finish();
}

Packet updateImage(std::string_view name, const Image& image, Bounds2i tile) {
  const std::size_t channels = image.channelCount();
  const std::size_t rowLength = static_cast<std::size_t>(tile.width()) * channels;
  Writer packet(PacketKind::UpdateImage);
  packet.reserve(rowLength * static_cast<std::size_t>(tile.height()) * sizeof(float) + name.size() +
                 64 * (channels + 1));
  packet.flag(false);
  packet.text(name);
  packet.number(static_cast<std::int32_t>(channels));
  for (const std::string& channel : image.channels()) packet.text(channel);
  for (const int value : {tile.min.x, tile.min.y, tile.width(), tile.height()})
    packet.number(static_cast<std::int32_t>(value));
  for (std::size_t c = 0; c < channels; ++c)
    packet.number(static_cast<std::int64_t>(c));  // first of the channel
  for (std::size_t c = 0; c < channels; ++c)
    packet.number(static_cast<std::int64_t>(channels));  // from pixel to pixel
  for (int y = tile.min.y; y < tile.max.y; ++y) {
    const std::size_t first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
                               static_cast<std::size_t>(tile.min.x)) *
                              channels;
    packet.floats(image.data().data() + first, rowLength);
  }
  return packet.finish();
}

Packet closeImage(std::string_view name) {
  Writer packet(PacketKind::CloseImage);
  packet.text(name);
  return packet.finish();
}

}  // namespace pbrtmedia::tev
