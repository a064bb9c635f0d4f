// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "main/options.h"

// What the texts of some options stand for, and checks of such texts whose errors tell what was expected.

namespace pbrtmedia {

/// "16:64" as numbers; nothing for what is no range.
std::optional<SampleRange> parseSampleRange(const std::string& text);
/// Of --samples: see parseSampleRange.
CLI::Validator sampleRange();
/// A name that is not empty: an empty one is most likely that of a variable of a script that is not set.
CLI::Validator fileName();
/// Of --frames: see parseFrameRange.
CLI::Validator frameRange();
/// Of --derivative: the name of a variable.
CLI::Validator variableName();
/// Of --define: NAME=VALUE.
CLI::Validator definition();

}  // namespace pbrtmedia
