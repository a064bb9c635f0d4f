// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace pbrtmedia {

/// What a file of ours holds beside text: numbers of one size, lowest byte first on every machine.
template <class T>
concept FileNumber = std::unsigned_integral<T> || std::same_as<T, float> || std::same_as<T, double>;

/// Puts numbers and texts one after the other.
class ByteWriter {
 public:
  /// What is handed on at a time, bytes.
  static constexpr std::size_t kBlock = std::size_t{1} << 20;
  using Sink = std::function<void(std::string_view)>;

  /// Keeps everything in memory.
  ByteWriter() = default;
  /// Hands on block by block, the last one with `finish`.
  explicit ByteWriter(Sink sink) : sink_(std::move(sink)) {}

  template <FileNumber T>
  void add(T number) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &number, sizeof number);
    if constexpr (!kIsLittle) {
      for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    }
    addPlain({bytes, sizeof bytes});
  }
  /// Length (u32) and bytes.
  void add(const std::string& text) {
    if (text.size() > ~std::uint32_t{0}) throw std::length_error("a text of more than 4 GiB");
    add(static_cast<std::uint32_t>(text.size()));
    addPlain(text);
  }
  /// Count (u64) and numbers.
  template <FileNumber T>
  void addArray(std::span<const T> numbers) {
    add(static_cast<std::uint64_t>(numbers.size()));
    if constexpr (kIsLittle) {
      addPlain({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
    } else {
      for (const T number : numbers) add(number);
    }
  }
  void addPlain(std::string_view bytes) {
    while (sink_ && text_.size() + bytes.size() >= kBlock) {
      const std::string_view part = bytes.substr(0, kBlock - text_.size());
      text_ += part;
      bytes.remove_prefix(part.size());
      sink_(text_);
      text_.clear();
    }
    text_ += bytes;
  }
  /// What was not handed on yet.
  const std::string& text() const { return text_; }
  void finish() {
    if (sink_ && !text_.empty()) sink_(text_);
    text_.clear();
  }

 private:
  static constexpr bool kIsLittle = std::endian::native == std::endian::little;
  Sink sink_;
  std::string text_;
};

/// Takes what a ByteWriter put. Throws std::length_error for more than there is; takes no memory before it
/// knows that the bytes are there.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <FileNumber T>
  T number() {
    const std::string_view bytes = take(sizeof(T));
    if constexpr (std::unsigned_integral<T>) {
      T value = 0;
      for (std::size_t i = 0; i < sizeof(T); ++i) {
        value = static_cast<T>(
            value | static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[i])) << (8 * i)));
      }
      return value;
    } else {
      using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
      return std::bit_cast<T>(ByteReader(bytes).number<Bits>());
    }
  }
  std::string text() { return std::string(take(number<std::uint32_t>())); }
  template <FileNumber T>
  std::vector<T> array() {
    std::vector<T> numbers(count(sizeof(T)));
    if constexpr (std::endian::native == std::endian::little) {
      const std::string_view bytes = take(numbers.size() * sizeof(T));
      if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    } else {
      for (T& number : numbers) number = this->number<T>();
    }
    return numbers;
  }
  /// How many things follow (u64), of at least so many bytes each.
  std::size_t count(std::size_t bytesEach) {
    const auto many = number<std::uint64_t>();
    if (many > rest_.size() / bytesEach) throw std::length_error("fewer bytes than they should be");
    return static_cast<std::size_t>(many);
  }
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw std::length_error("truncated");
    const std::string_view bytes = rest_.substr(0, static_cast<std::size_t>(count));
    rest_.remove_prefix(bytes.size());
    return bytes;
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

}  // namespace pbrtmedia
