// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace pbrtmedia::test {

/// An image as a viewer holds it: a plane for each channel.
struct ViewerImage {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> planes;
};

/// What the packets of tev's protocol did so far, decoded byte by byte by rules of its own; throws
/// std::runtime_error for a packet that tev would not take.
class TevPackets {
 public:
  std::map<std::string, ViewerImage> images;
  int created = 0, closed = 0, updates = 0;
  std::size_t pixelsUpdated = 0;

  /// One packet with its length in front.
  void take(const std::string& packet) {
    at_ = 0;
    packet_ = &packet;
    require(number(4) == packet.size(), "length");
    const auto kind = number(1);
    if (kind == 2) {
      images.erase(text());
      ++closed;
    } else if (kind == 4) {
      create();
    } else {
      require(kind == 6, "kind");
      update();
    }
    require(at_ == packet.size() || kind == 6, "bytes left over");
  }

 private:
  void create() {
    require(number(1) <= 1, "flag");
    const std::string name = text();
    ViewerImage image;
    image.width = static_cast<int>(number(4));
    image.height = static_cast<int>(number(4));
    const auto channels = number(4);
    for (std::uint64_t c = 0; c < channels; ++c) {
      const std::string channel = text();
      require(image.planes
                  .emplace(channel, std::vector<float>(static_cast<std::size_t>(image.width) *
                                                       static_cast<std::size_t>(image.height)))
                  .second,
              "a channel twice");
    }
    require(images.count(name) == 0, "an image of that name is there");
    images[name] = std::move(image);
    ++created;
  }

  void update() {
    require(number(1) <= 1, "flag");
    const std::string name = text();
    require(images.count(name) == 1, "no image of that name");
    ViewerImage& image = images[name];
    std::vector<std::string> channels(number(4));
    for (std::string& channel : channels) channel = text();
    const auto x = number(4), y = number(4), width = number(4), height = number(4);
    require(x + width <= static_cast<std::uint64_t>(image.width), "beyond the right edge");
    require(y + height <= static_cast<std::uint64_t>(image.height), "beyond the bottom");
    std::vector<std::uint64_t> offsets(channels.size()), strides(channels.size());
    for (auto& offset : offsets) offset = number(8);
    for (auto& stride : strides) stride = number(8);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      require(image.planes.count(channels[c]) == 1, "no channel of that name");
      for (std::uint64_t i = 0; i < width * height; ++i) {
        const std::size_t to = (y + i / width) * static_cast<std::size_t>(image.width) + x + i % width;
        image.planes[channels[c]][to] = floatAt(at_ + 4 * (offsets[c] + i * strides[c]));
      }
    }
    ++updates;
    pixelsUpdated += width * height;
  }

  static void require(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(std::string("bad packet: ") + what);
  }
  std::uint64_t numberAt(std::size_t at, std::size_t bytes) const {
    require(at + bytes <= packet_->size(), "ends early");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>((*packet_)[at + i])) << (8 * i);
    return value;
  }
  std::uint64_t number(std::size_t bytes) {
    const std::uint64_t value = numberAt(at_, bytes);
    at_ += bytes;
    return value;
  }
  float floatAt(std::size_t at) const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(numberAt(at, 4)));
  }
  std::string text() {
    const std::size_t end = packet_->find('\0', at_);
    require(end != std::string::npos, "a text without end");
    const std::string value = packet_->substr(at_, end - at_);
    at_ = end + 1;
    return value;
  }

  const std::string* packet_ = nullptr;
  std::size_t at_ = 0;
};

/// A viewer that listens at a port of the loopback interface, as tev does.
class TevViewer {
 public:
  struct Manners {
    bool reads = true;                 ///< false: accepts, and takes nothing
    int packetsBeforeDeath = 1 << 30;  ///< then it closes its connection and listens no more
    int port = 0;                      ///< 0: any that is free
  };

  TevViewer() : TevViewer(Manners{}) {}
  explicit TevViewer(const Manners& manners) : manners_(manners) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int on = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(manners.port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listener_, 4) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      throw std::runtime_error("the test's viewer cannot listen");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~TevViewer() {
    isEnding_ = true;
    ::shutdown(listener_, SHUT_RDWR);
    const int connection = connection_;
    if (connection >= 0) ::shutdown(connection, SHUT_RDWR);
    thread_.join();
    ::close(listener_);
  }
  TevViewer(const TevViewer&) = delete;
  TevViewer& operator=(const TevViewer&) = delete;

  int port() const { return port_; }
  std::string endpoint() const { return "127.0.0.1:" + std::to_string(port_); }
  /// What came so far; `problem` is "" when all of it was good.
  TevPackets packets() const {
    const std::lock_guard lock(mutex_);
    return packets_;
  }
  std::string problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
  }
  bool isDead() const { return isDead_; }
  /// Waits until what came is as wanted; false after ten seconds.
  bool waitFor(const std::function<bool(const TevPackets&)>& isWanted) const {
    for (int i = 0; i < 1000; ++i) {
      if (isWanted(packets())) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

 private:
  void serve() {
    while (!isEnding_ && !isDead_) {
      const int connection = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (connection < 0) break;
      connection_ = connection;
      while (!manners_.reads && !isEnding_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      receive(connection);
      connection_ = -1;
      ::close(connection);
    }
    ::shutdown(listener_, SHUT_RDWR);  // nobody is taken any more
  }

  void receive(int connection) {
    for (int count = 0; !isEnding_; ++count) {
      if (count >= manners_.packetsBeforeDeath) {
        isDead_ = true;
        return;
      }
      std::string packet = read(connection, 4);
      if (packet.size() < 4) return;
      std::uint32_t length = 0;
      for (std::size_t i = 0; i < 4; ++i)
        length |= static_cast<std::uint32_t>(static_cast<unsigned char>(packet[i])) << (8 * i);
      const std::string rest = read(connection, length - 4);
      if (rest.size() < length - 4) return;
      const std::lock_guard lock(mutex_);
      try {
        packets_.take(packet + rest);
      } catch (const std::runtime_error& e) {
        problem_ = e.what();
      }
    }
  }

  static std::string read(int connection, std::size_t size) {
    std::string bytes(size, '\0');
    std::size_t have = 0;
    while (have < size) {
      const ssize_t n = ::recv(connection, bytes.data() + have, size - have, 0);
      if (n <= 0) break;
      have += static_cast<std::size_t>(n);
    }
    bytes.resize(have);
    return bytes;
  }

  Manners manners_;
  int listener_ = -1, port_ = 0;
  std::atomic<int> connection_{-1};
  std::atomic<bool> isEnding_{false}, isDead_{false};
  mutable std::mutex mutex_;
  TevPackets packets_;
  std::string problem_;
  std::thread thread_;
};

}  // namespace pbrtmedia::test
