// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "cameras/lens_system.h"

namespace pbrtmedia {

/// What a lens file says of lenses, front to rear. Scene-language reference 9.4.
struct LensFile {
  std::vector<LensElement> elements;

  /// Sets the diameter of the stops, in millimetres. The diameter of the narrowest stop that is narrower than
  /// that, which it stays.
  std::optional<float> setAperture(float diameter);
};

/// Rows of four numbers: curvature radius (0: the stop), distance to the next element, index of refraction
/// (0: air) and aperture diameter, lengths in millimetres. Throws SceneError when rows are incomplete or
/// there are none, more than `kMostLenses`, or what `parseNumberText` refuses; `tolerate` as there.
LensFile parseLensText(std::string_view text, const std::filesystem::path& shownName, Diagnostics* tolerate);
inline constexpr std::size_t kMostLenses = 100;

/// The same from a file, which may be missing or unreadable.
LensFile readLensFile(const std::filesystem::path& path, Diagnostics* tolerate);

}  // namespace pbrtmedia
