// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <ImfIO.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

namespace pbrtmedia {

/// OpenEXR's view of bytes in memory.
class ExrMemoryInput final : public Imf::IStream {
 public:
  ExrMemoryInput(std::span<const std::byte> bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}
  bool read(char* out, int count) override {
    if (count < 0 || position_ > bytes_.size() ||
        static_cast<std::size_t>(count) > bytes_.size() - position_) {
      throw std::runtime_error("the file ends early");
    }
    std::memcpy(out, bytes_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<std::size_t>(count);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = static_cast<std::size_t>(position); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
};

/// Collects what OpenEXR writes, which seeks back to fill its table of offsets.
class ExrMemoryOutput final : public Imf::OStream {
 public:
  ExrMemoryOutput() : Imf::OStream("image") {}
  void write(const char* data, int count) override {
    const std::size_t n = static_cast<std::size_t>(count);
    if (position_ + n > bytes_.size()) bytes_.resize(position_ + n);
    std::memcpy(bytes_.data() + position_, data, n);
    position_ += n;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = static_cast<std::size_t>(position); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

}  // namespace pbrtmedia
