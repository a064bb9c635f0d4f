// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "media/bounds_cache.h"
#include "world/scene.h"

namespace pbrtmedia {

/// `--bounds-cache`: bounds learned by earlier renders, and by this one for later ones.
class KeptBounds {
 public:
  /// Reads the file if there is one. Throws SceneError when it is broken. Nothing: keeps nothing.
  explicit KeptBounds(const std::optional<std::filesystem::path>& file);

  /// Starts the media of a scene with their bounds. Answers warnings, a line each: what starts afresh, and
  /// why.
  std::string restore(const std::string& sceneName, const Scene& scene) const;
  /// Writes the file, with what it knew of other scenes.
  void save(const std::string& sceneName, const Scene& scene);

 private:
  std::optional<std::filesystem::path> file_;
  std::optional<BoundsCache> cache_;  ///< nothing before the first render
};

}  // namespace pbrtmedia
