// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>

namespace pbrtmedia {

inline constexpr int kCieFirstWavelength = 360;      ///< nm
inline constexpr int kCieLastWavelength = 830;       ///< nm
inline constexpr std::size_t kCieSampleCount = 471;  ///< one per nm
/// The normalisation PBRT-v3 divides by. The sum of the ȳ column itself is 106.856917101; 2e-7 apart.
inline constexpr double kCieYIntegral = 106.856895;

/// One row of the CIE 1931 standard colorimetric observer (2 degrees), dimensionless.
struct Cie1931Entry {
  double x, y, z;
};

/// Rows for 360, 361, ..., 830 nm. Source: CIE dataset doi:10.25039/CIE.DS.xvudnb9b (ISO/CIE 11664-1), whose
/// column sums 106.865469489595, 106.856917101172 and 106.892251278636 a test repeats.
const std::array<Cie1931Entry, kCieSampleCount>& cie1931();

}  // namespace pbrtmedia
