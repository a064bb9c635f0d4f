// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/stress.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <stdexcept>
#include <variant>

#include "base/diagnostics.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "tools/medialab/reciprocal_verdict.h"
#include "tools/medialab/stress_cases.h"
#include "tools/medialab/verdict.h"

namespace pbrtmedia {
namespace {

/// What a cell may spend. Trials end where the look-ups measured so far reach the budget, not the clock, so
/// that the table is the same on every machine.
struct Budget {
  std::uint64_t trials, lookups;
  double seconds;        ///< of processor time; far more than the look-ups take
  double predictedCost;  ///< look-ups of one estimate that are not even tried
};
constexpr Budget kFull{100000, 20000000, 60, 1e8}, kQuick{400, 40000, 10, 3e6};

struct Cell {
  const LabEstimator* estimator;
  const StressCase* one;
  LabProblem problem;
  /// What is known of the line, for either quantity.
  std::variant<StressSetting, ReciprocalSetting> setting;
  std::string whySkipped;
};

std::vector<StressCase> selectCases(const StressOptions& o, Quantity quantity) {
  std::vector<StressCase> all = quantity == Quantity::Reciprocal ? reciprocalStressCases() : stressCases();
  std::vector<StressCase> chosen;
  for (const std::string& word : o.cases) {
    const bool isKnown = std::any_of(all.begin(), all.end(), [&](const StressCase& c) {
      return std::string_view(c.name).substr(0, word.size()) == word;
    });
    if (isKnown) continue;
    std::vector<std::string_view> names;
    for (const StressCase& c : all) names.emplace_back(c.name);
    throw std::runtime_error("unknown case \"" + word + '"' + suggestion(word, names));
  }
  for (StressCase& c : all) {
    const bool isNamed = std::any_of(o.cases.begin(), o.cases.end(), [&](const std::string& word) {
      return std::string_view(c.name).substr(0, word.size()) == word;
    });
    if (o.cases.empty() ? (!o.isQuick || c.isQuick) : isNamed) chosen.push_back(std::move(c));
  }
  return chosen;
}

/// Look-ups of one estimate, where they grow with the control and are known before. Walks make as many as
/// the control is deep, and combs that it sizes have teeth in proportion.
double predictedCost(const Cell& cell) {
  if (const auto* reciprocal = std::get_if<ReciprocalSetting>(&cell.setting)) {
    return cell.estimator->reciprocalTraits().costGrowsWithControl ? reciprocal->controlOverF : 0;
  }
  const bool costGrows = cell.estimator->traits().control != EstimatorTraits::Control::Unused;
  return costGrows ? cell.problem.controlDepth() : 0;
}

/// Why a cell is not even tried; empty if it is.
std::string whySkipped(const Cell& cell, const Budget& budget) {
  std::string why = whyNotApplicable(*cell.estimator, cell.problem.line);
  // Where there is no control, there is no cost.
  if (!why.empty() || !(cell.problem.line.upperIntegral() > 0)) return why;
  if (const double cost = predictedCost(cell); cost > budget.predictedCost) {
    why = std::holds_alternative<ReciprocalSetting>(cell.setting) ? "cost ~ alpha / F: "
                                                                  : "cost ~ optical depth of the control: ";
    why += formatNumber(std::round(cost)) + " look-ups predicted";
  }
  return why;
}

Cell cellOf(const LabEstimator& estimator, const StressCase& one, const Budget& budget) {
  const CanonicalLine line(one.function, one.setup);
  const double integral = line.integral();
  const double sigmaT = integral > 0 ? one.depth / integral : one.sigmaOfNothing;
  Cell cell{&estimator, &one, {line, sigmaT}, {}, ""};
  if (estimator.quantity() == Quantity::Reciprocal) {
    ReciprocalSetting setting = reciprocalSettingOf(line, sigmaT);
    setting.isBlind = one.isBlind;
    cell.setting = setting;
  } else {
    cell.setting = StressSetting{.exact = cell.problem.exact(estimator),
                                 .depth = cell.problem.depth(),
                                 .controlDepth = cell.problem.controlDepth(),
                                 .control = one.setup.control,
                                 .isBounding = one.setup.control >= 1,
                                 .isBlind = one.isBlind};
  }
  cell.whySkipped = whySkipped(cell, budget);
  return cell;
}

StressVerdict verdictOn(const Cell& cell, const IsolatedResult& result) {
  if (const auto* reciprocal = std::get_if<ReciprocalSetting>(&cell.setting)) {
    return judgeReciprocal(cell.estimator->reciprocalTraits(), *reciprocal, result);
  }
  return judge(cell.estimator->traits(), std::get<StressSetting>(cell.setting), result);
}

/// The verdict's reason, and whether look-ups were too dear for all trials.
std::string reasonOf(const StressVerdict& verdict, const TrialStats& stats, const Budget& budget) {
  std::string reason = verdict.reason;
  if (stats.trials() == 0 || stats.trials() >= budget.trials) return reason;
  if (!reason.empty()) reason += "; ";
  return reason + "trials ended at " + formatNumber(static_cast<double>(budget.lookups)) + " look-ups";
}

std::vector<LabTable::Cell> rowOf(const StressOptions& o, const Budget& budget, const Cell& cell,
                                  const IsolatedResult& result, const StressVerdict& verdict) {
  const TrialStats& s = result.stats;
  const bool hasTrials = s.trials() > 0;
  const double none = std::nan("");
  std::vector<LabTable::Cell> row{cell.estimator->label(),
                                  cell.one->name,
                                  cell.problem.depth(),
                                  cell.problem.controlDepth(),
                                  s.trials(),
                                  verdict.finite,
                                  verdict.inRange,
                                  hasTrials ? s.value.mean() : none,
                                  cell.problem.exact(*cell.estimator),
                                  verdict.z,
                                  verdict.unbiased,
                                  hasTrials ? s.lookupsPerTrial() : none,
                                  s.mostLookups};
  if (!o.lab.omitSeconds) row.emplace_back(hasTrials ? s.seconds : none);
  row.emplace_back(std::string(nameOf(verdict.kind)));
  row.emplace_back(reasonOf(verdict, s, budget));
  return row;
}

LabTable emptyTable(const StressOptions& o) {
  std::vector<std::string> columns{"estimator", "case",     "depth",       "control_depth", "trials",
                                   "finite",    "in_range", "mean",        "exact",         "z",
                                   "unbiased",  "lookups",  "most_lookups"};
  if (!o.lab.omitSeconds) columns.emplace_back("seconds");
  columns.insert(columns.end(), {"verdict", "reason"});
  return {o.lab.command, columns};
}

/// Runs the cells that are not skipped, each in a process of its own. In their order.
std::vector<IsolatedResult> runCells(const std::vector<Cell>& cells, const StressOptions& o,
                                     const Budget& budget, const StopSignal& stop) {
  std::vector<std::function<TrialStats()>> jobs;
  std::vector<const Cell*> cellOfJob;
  for (const Cell& cell : cells) {
    if (!cell.whySkipped.empty()) continue;
    cellOfJob.push_back(&cell);
    jobs.emplace_back([&cell, &budget, &o] {
      const std::uint64_t seed =
          hashCombine(o.lab.seed, hashBytes(cell.estimator->label()), hashBytes(cell.one->name));
      return runTrials(*cell.estimator, cell.problem, {}, seed,
                       {.trials = budget.trials, .lookups = budget.lookups});
    });
  }
  LabProgress progress("medialab stress", jobs.size(), o.lab.quiet);
  std::size_t done = 0;
  return runIsolated(jobs, threadCount(), budget.seconds, stop.flag(), [&](std::size_t job) {
    const Cell& cell = *cellOfJob[job];
    progress.update(++done, cell.estimator->label() + " on " + cell.one->name);
  });
}

StressVerdict skippedVerdict(const std::string& reason) {
  StressVerdict verdict;
  verdict.kind = StressVerdict::Kind::Skipped;
  verdict.reason = reason;
  verdict.finite = verdict.inRange = verdict.unbiased = "-";
  verdict.z = std::nan("");
  return verdict;
}

}  // namespace

LabTable stressTable(const StressOptions& o, const StopSignal& stop) {
  LabTable table = emptyTable(o);
  std::vector<LabTable::Skipped> skipped;
  const std::vector<LabEstimator> estimators = o.selection.select(skipped);
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  noteQuantity(table, estimators);
  const std::vector<StressCase> cases = selectCases(o, estimators.front().quantity());
  const Budget& budget = o.isQuick ? kQuick : kFull;
  std::vector<Cell> cells;
  for (const LabEstimator& estimator : estimators) {
    for (const StressCase& one : cases) cells.push_back(cellOf(estimator, one, budget));
  }
  const std::vector<IsolatedResult> results = runCells(cells, o, budget, stop);
  std::map<std::string_view, std::size_t> counts;
  std::size_t job = 0;
  for (const Cell& cell : cells) {
    const bool isSkipped = !cell.whySkipped.empty();
    const IsolatedResult result = isSkipped ? IsolatedResult{} : results[job++];
    if (!isSkipped && result.end == IsolatedResult::End::NotRun) continue;
    const StressVerdict verdict = isSkipped ? skippedVerdict(cell.whySkipped) : verdictOn(cell, result);
    ++counts[nameOf(verdict.kind)];
    table.add(rowOf(o, budget, cell, result, verdict));
  }
  std::string summary = "verdicts:";
  for (const auto& [kind, count] : counts) {
    summary += ' ';
    summary += kind;
    summary += ' ' + std::to_string(count);
  }
  table.note(summary);
  if (stop) table.markStopped();
  return table;
}

int runStress(const StressOptions& options) {
  checkOutput(options.lab);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  const LabTable table = stressTable(options, stop);
  writeTable(table, options.lab);
  const std::size_t verdict = table.column("verdict");
  const bool hasFailed = std::any_of(table.rows().begin(), table.rows().end(), [&](const auto& row) {
    return row[verdict].text() == nameOf(StressVerdict::Kind::Fail);
  });
  return hasFailed || stop ? 1 : 0;
}

}  // namespace pbrtmedia
