// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "scene/input_folders.h"
#include "scene/param_type.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Turns what a spectral parameter says into RGB: numbers, or names of files, each of which is read once.
/// Both functions leave the colours in `param`; false: a problem was reported, beginning with `what`. Black,
/// and handed to `tolerate`, are a file that is missing or cannot be read and a black body without
/// temperature.
class SpectrumValues {
 public:
  using Tolerate =
      std::function<void(const SourceLocation& at, const std::string& found, std::string_view consequence)>;

  /// `readFiles`: false makes every file black, unread.
  SpectrumValues(Diagnostics& diagnostics, bool readFiles)
      : diagnostics_(diagnostics), readFiles_(readFiles) {}

  bool fromNumbers(Param& param, const ParamType& type, std::span<const float> numbers,
                   const std::string& what, const Tolerate& tolerate);
  /// The names are the strings that `param` holds.
  bool fromFiles(Param& param, const InputFolders& folders, const std::string& what,
                 const Tolerate& tolerate);
  /// Those that were read, each with what came of it.
  const std::map<std::filesystem::path, std::optional<Rgb>>& files() const { return spectra_; }

 private:
  Diagnostics& diagnostics_;
  bool readFiles_;
  std::map<std::filesystem::path, std::optional<Rgb>> spectra_;  ///< files read before; nothing: unusable
};

}  // namespace pbrtmedia
