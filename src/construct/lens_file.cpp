// SPDX-License-Identifier: BSD-2-Clause
#include "construct/lens_file.h"

#include <algorithm>
#include <memory>
#include <string>

#include "base/files.h"
#include "spectrum/spectrum.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kColumns = 4;
constexpr double kMillimetre = 0.001;
constexpr std::size_t kMostBytes = std::size_t{1} << 20;  // of a file, unpacked

}  // namespace

std::optional<float> LensFile::setAperture(float diameter) {
  std::optional<float> narrowest;
  for (LensElement& e : elements) {
    if (!e.isStop()) continue;
    const double radius = kMillimetre * static_cast<double>(diameter) / 2;
    if (radius <= e.apertureRadius) {
      e.apertureRadius = radius;
      continue;
    }
    const auto own = static_cast<float>(2 * e.apertureRadius / kMillimetre);
    narrowest = std::min(narrowest.value_or(own), own);
  }
  return narrowest;
}

LensFile parseLensText(std::string_view text, const std::filesystem::path& shownName, Diagnostics* tolerate) {
  const std::vector<float> numbers = parseNumberText(text, shownName, tolerate);
  const auto fail = [&](const std::string& found) {
    throw SceneError(
        SourceLocation{std::make_shared<const std::string>(shownName.string())},
        "a lens file needs rows of 4 numbers: curvature radius, distance, index of refraction and "
        "aperture diameter; found " +
            found);
  };
  if (numbers.empty() || numbers.size() % kColumns != 0) fail(std::to_string(numbers.size()) + " numbers");
  if (numbers.size() / kColumns > kMostLenses) {
    fail(std::to_string(numbers.size() / kColumns) + " rows, expected at most " +
         std::to_string(kMostLenses));
  }
  LensFile lenses;
  for (std::size_t i = 0; i < numbers.size(); i += kColumns) {
    const auto at = [&](std::size_t column) { return static_cast<double>(numbers[i + column]); };
    lenses.elements.push_back({.curvatureRadius = kMillimetre * at(0),
                               .thickness = kMillimetre * at(1),
                               .eta = at(2) == 0 ? 1 : at(2),
                               .apertureRadius = kMillimetre * at(3) / 2});
  }
  return lenses;
}

LensFile readLensFile(const std::filesystem::path& path, Diagnostics* tolerate) {
  const FileBytes bytes = FileBytes::open(path, kMostBytes);
  return parseLensText(bytes.text(), path, tolerate);
}

}  // namespace pbrtmedia
