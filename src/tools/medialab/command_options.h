// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"
#include "transmittance/sampling_pattern.h"

// The options that the commands of the lab share.

namespace pbrtmedia {

using Run = std::function<int()>;

/// Beyond, a row would take weeks; far below what counters hold.
inline constexpr unsigned long long kMostTrials = 1'000'000'000'000;
inline constexpr unsigned kMostSamples = 1u << 24;

/// The words that were typed, told apart by what they are for.
struct Words {
  std::string command, identity;
};

/// Of a command that writes a table.
void addTableOptions(CLI::App* c, LabOptions& o);
void addLabOptions(CLI::App* c, LabOptions& o, const Words& words);
/// Of a command whose measurements may be kept while they are made.
void addResume(CLI::App* c, LabOptions& o);
void addQuantity(CLI::App* c, EstimatorSelection& o);
void addSelection(CLI::App* c, EstimatorSelection& o);
void addProblem(CLI::App* c, ProblemOptions& o, bool hasDepths);
void addFunctions(CLI::App* c, FunctionSelection& o, const std::string& fallback);
/// Of a command that works on one.
void addFunction(CLI::App* c, FunctionSelection& o);
void addPattern(CLI::App* c, PatternKind& pattern);

}  // namespace pbrtmedia
