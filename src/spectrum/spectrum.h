// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// CIE XYZ to linear Rec. 709 RGB, no adaptation (scene-language reference 4).
Rgb xyzToRgb(Rgb xyz);

/// One sample of a spectral curve.
struct SpectralSample {
  float wavelength;  ///< nm
  float value;
};

/// A sampled spectrum to RGB: sorted by wavelength, linear interpolation, constant extrapolation, CIE 1931
/// 2-degree functions at 1 nm from 360 to 830 nm. Throws std::invalid_argument for no samples, a non-finite
/// number or a repeated wavelength.
Rgb sampledSpectrumToRgb(std::vector<SpectralSample> samples);

/// s · B(λ, T) / B(λ_max, T) as RGB: peak 1 before scaling. Throws std::invalid_argument unless T > 0 and
/// finite.
Rgb blackbodyToRgb(float kelvin, float scale);

/// Numbers of a .spd or lens file: separated by blanks or line ends, `#` comments. Throws SceneError with
/// line and column at the first thing that is not a finite number. With `tolerate` what stands between runs
/// of digits, signs, points and exponents is skipped as in PBRT-v3, and said there once.
std::vector<float> parseNumberText(std::string_view text, const std::filesystem::path& shownName,
                                   Diagnostics* tolerate = nullptr);

/// The samples of a .spd text, in its order. Throws SceneError for no numbers, an odd count, or what
/// `parseNumberText` refuses. With `tolerate` the last of an odd count is left out. A repeated wavelength is
/// left to `sampledSpectrumToRgb`.
std::vector<SpectralSample> parseSpectrumText(std::string_view text, const std::filesystem::path& shownName,
                                              Diagnostics* tolerate = nullptr);

/// Reads a .spd file (wavelength value pairs). Throws SceneError when it cannot be read or is not such a
/// file.
std::vector<SpectralSample> readSpectrumFile(const std::filesystem::path& path,
                                             Diagnostics* tolerate = nullptr);

}  // namespace pbrtmedia
