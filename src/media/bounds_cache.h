// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "media/medium.h"

namespace pbrtmedia {

/// Learned bounds of media (LearnedBounds) in a file, so that the next render starts with them. They stand
/// under the name of a scene and of a medium. The file is the same on every machine:
///   "pbrt-media bounds 1\n", number of entries (u64); for each scene and medium (u32 length, bytes), cells
///   in x, y, z (u64), epsilon and slack (f32), upper and lower bound of every cell, x fastest (f32);
///   hashBytes of all that (u64). Little-endian; bounds and epsilon are densities.
class BoundsCache {
 public:
  BoundsCache() = default;
  /// Throws SceneError at the file when it cannot be read, is of another kind or version, truncated or
  /// corrupt.
  static BoundsCache read(const std::filesystem::path& path);

  /// Starts the medium, whose bounds are learned, with those kept. Empty when that was done; else the reason
  /// why it starts afresh.
  std::string restore(const std::string& scene, Medium& medium) const;
  /// Keeps the bounds in force of such a medium.
  void keep(const std::string& scene, Medium& medium);
  /// Throws std::runtime_error; an older file is then as it was.
  void write(const std::filesystem::path& path) const;
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::array<std::uint64_t, 3> cells{};
    float epsilon = 0, slack = 0;
    std::vector<float> bounds;
  };
  using Name = std::pair<std::string, std::string>;  ///< scene, medium
  std::map<Name, Entry> entries_;
};

}  // namespace pbrtmedia
