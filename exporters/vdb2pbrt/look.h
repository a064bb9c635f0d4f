// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "vdb2pbrt/conversion.h"
#include "vdb2pbrt/volume.h"

namespace pbrtmedia {

/// The options with what was not given chosen for a volume:
///
///  - `sigmaA` 1 1 1 where something glows, for what absorbs nothing emits nothing; else 0, or 0.03 with a
///    scene. `sigmaS` 1 1 1.
///  - `scale` 1; with a scene such that nine of ten rays of its camera that meet the volume have an optical
///    depth of at most kSceneDepth, or kGlowDepth where something glows.
///  - `temperatureScale` 1; for numbers that cannot be kelvin, as all are at most 100, the one that makes the
///    hottest kHottest.
///  - `leScale` such that the hot parts have the radiance kRadiance in their strongest channel; `le` orange.
///  - `up` z for files of Blender, else y.
///
/// Everything chosen is told, with the option that says it otherwise.
ConversionOptions lookFor(const Volume& volume, const ConversionOptions& options, const Notice& notice);

inline constexpr double kSceneDepth = 8, kGlowDepth = 3;
inline constexpr double kHottest = 2200;  ///< kelvin; flames of soot have 1500 to 2200
inline constexpr double kRadiance = 6;

}  // namespace pbrtmedia
