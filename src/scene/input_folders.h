// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace pbrtmedia {

/// Where relative file names of a directive are looked for.
struct InputFolders {
  std::filesystem::path base;  ///< folder of the file named on the command line; PBRT-v3's rule
  std::filesystem::path own;   ///< folder of the file the directive stands in

  struct Found {
    std::filesystem::path path;
    bool besideIncluder = false;  ///< only found in `own`: deserves a warning, PBRT-v3 would miss it
    /// False of a folder, and of a file that may not be read.
    bool canBeOpened() const;
  };
  /// The name under `base`, else under `own`; nothing when neither exists. Absolute names stay as they are.
  std::optional<Found> locate(std::string_view name) const;
  /// The path PBRT-v3 would open, whether it exists or not.
  std::filesystem::path underBase(std::string_view name) const;
};

}  // namespace pbrtmedia
