// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace pbrtmedia {

/// Bytes that a packed file may unpack to: 2 GiB, and 128 for each of its own. Real volumes and scenes pack
/// to a tenth or a hundredth, an empty grid of 2 GiB to 2 MB; so a small file cannot take all the memory
/// there is.
constexpr std::uint64_t mostUnpacked(std::uint64_t packed) {
  constexpr std::uint64_t kAlways = std::uint64_t{2} << 30, kPerByte = 128;
  return kAlways + kPerByte * packed;
}

/// The bytes of a whole file, memory-mapped; gzip (by its magic bytes) is unpacked into memory. Move-only.
/// Throws SceneError (location: the file) when it cannot be opened, is a directory or the pointer that Git
/// LFS leaves in the place of a file, or the gzip data is truncated or corrupt. Safe to read from many
/// threads.
class FileBytes {
 public:
  /// What a gzip file grows to is bounded by `mostUnpacked`, and by `maxUnpacked`. Memory grows as bytes
  /// come.
  static FileBytes open(const std::filesystem::path& path,
                        std::size_t maxUnpacked = std::numeric_limits<std::size_t>::max());
  /// Everything on a stream descriptor until end of file (standard input), unpacked when it is gzip.
  static FileBytes readDescriptor(int descriptor, const std::string& shownName);
  FileBytes(FileBytes&& o) noexcept;
  FileBytes& operator=(FileBytes&& o) noexcept;
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  ~FileBytes();

  std::string_view text() const { return {data_, size_}; }
  std::span<const std::byte> bytes() const { return {reinterpret_cast<const std::byte*>(data_), size_}; }
  /// Backed by the file itself: released bytes can be read again.
  bool isMapped() const { return mapped_; }
  /// Gives back the memory of the first `count` bytes. They must not be read again: what was unpacked or came
  /// from a stream reads as zeros from now on.
  void releaseUpTo(std::size_t count) const;

 private:
  FileBytes(const char* data, std::size_t size, bool mapped) : data_(data), size_(size), mapped_(mapped) {}
  const char* data_ = nullptr;
  std::size_t size_ = 0;
  bool mapped_ = false;  ///< data_ is a mapping of the file, else it comes from malloc
};

/// Writes a file under a temporary name in the same folder, flushes it to the disk and renames it over
/// `path`; on any failure (or an exception of `write`) the temporary is removed and the old file is left as
/// it was. Throws std::runtime_error naming the path and the system's reason.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);
/// Removes what killed processes of this machine left beside `path` when they were writing it.
void removeLeftParts(const std::filesystem::path& path);

}  // namespace pbrtmedia
