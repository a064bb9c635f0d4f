// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "scene/param_reader.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

// How construction keeps the rule for files: what PBRT-v3 renders is rendered, with a word at its place that
// `Diagnostics::tolerated` makes an error with --strict; values of this renderer's own parameters are never
// guessed.

/// Says at a parameter what is wrong and what is taken instead: `context: parameter "name": message`.
void tolerate(ParamReader& in, ParamKind kind, std::string_view name, const std::string& message);
/// The same at the directive: `context: message`.
void tolerate(ParamReader& in, const std::string& message);

/// A number for a message, with the digits that tell it.
std::string shownNumber(float value);

/// A number that PBRT-v3 moves into `range`, or uses as if it did: moved to its nearer end (closed ones) and
/// told of.
int findIntWithin(ParamReader& in, std::string_view name, int fallback, Range range);
float findFloatWithin(ParamReader& in, std::string_view name, float fallback, Range range);
std::optional<int> optionalIntWithin(ParamReader& in, std::string_view name, Range range);

/// Index into `choices` of a word of a parameter that only this renderer has: an unknown one is an error.
std::size_t findOwnChoice(ParamReader& in, std::string_view name, std::span<const std::string_view> choices,
                          std::size_t fallback);

/// The file of a parameter that must be there: absent, "" or missing is an error.
std::optional<std::filesystem::path> requireFile(ParamReader& in, std::string_view name);

/// A problem of a file found while it is read, with its place in the file where it has one.
std::string problemOf(const SceneError& e);

/// A coefficient or radiance without negative channels: those count as 0, which is told. A warning where the
/// colour was computed from a spectrum (it lies outside of what RGB can hold), tolerated where it is written.
Rgb nonNegative(ParamReader& in, std::string_view name, Rgb colour);

/// Sets negative numbers to 0 and says once how many there were in `what` and at which sample of the nx by ny
/// by nz grid the first stands; NaN and infinities stay.
void clampNegatives(std::span<float> values, int nx, int ny, std::string_view what, const SourceLocation& at,
                    std::string_view context, Diagnostics& diagnostics);
/// The message of it: `what` is the first place ("voxel (1, 2, 3)").
std::string negativesMessage(std::size_t count, std::string_view first, float value);

}  // namespace pbrtmedia
