// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"
#include "tools/medialab/trials.h"
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

/// A command that writes a table, with the options that all of these share.
CLI::App* addTableCommand(CLI::App& app, const char* name, const char* about, LabOptions& o,
                          const Words& words);
/// What the command does with its options, which live as long as the program.
template <class Options, class Taken>
void runWhenChosen(CLI::App* c, Run& run, const Options& o, int (*command)(const Taken&)) {
  c->callback([&o, &run, command] { run = [&o, command] { return command(o); }; });
}

void addLabOptions(CLI::App* c, LabOptions& o, const Words& words);
/// Of a command whose measurements may be kept while they are made.
void addResume(CLI::App* c, LabOptions& o);
void addSelection(CLI::App* c, EstimatorSelection& o);
/// The same of a command that measures estimators of reciprocals too.
void addMeasured(CLI::App* c, EstimatorSelection& o);
void addProblem(CLI::App* c, ProblemOptions& o, bool hasDepths);
void addFunctions(CLI::App* c, FunctionSelection& o, const std::string& fallback);
/// Of a command that works on one.
void addFunction(CLI::App* c, FunctionSelection& o);
void addPattern(CLI::App* c, PatternKind& pattern);
void addPlan(CLI::App* c, TrialPlan& plan);

}  // namespace pbrtmedia
