// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/estimate.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "base/parallel.h"
#include "tools/medialab/journal.h"

namespace pbrtmedia {
namespace {

std::vector<std::string> columnsOf(const EstimateOptions& o) {
  std::vector<std::string> columns{"estimator", "extinction", "depth", "control"};
  if (o.showLower) columns.insert(columns.end(), {o.problem.lowerDepths.empty() ? "lower" : "lower_depth"});
  if (o.showLaw) columns.insert(columns.end(), {"law"});
  if (o.showPattern) columns.insert(columns.end(), {"pattern"});
  columns.insert(columns.end(),
                 {"trials", "exact", "mean", "mean_stderr", "variance", "variance_stderr", "lookups"});
  if (!o.lab.omitSeconds) columns.insert(columns.end(), {"seconds_per_estimate"});
  columns.insert(columns.end(), {"inverse_efficiency_lookups"});
  if (!o.lab.omitSeconds) columns.insert(columns.end(), {"inverse_efficiency_seconds"});
  columns.insert(columns.end(), {"non_finite"});
  return columns;
}

std::vector<LabTable::Cell> rowOf(const EstimateOptions& o, const LabEstimator& estimator,
                                  const CanonicalFunction& function, const ProblemChoice& choice,
                                  double exact, const TrialStats& stats) {
  std::vector<LabTable::Cell> row{estimator.label(), function.about().name, choice.depth, choice.control};
  if (o.showLower) row.emplace_back(choice.lower);
  if (o.showLaw) row.emplace_back(std::string(nameOf(estimator.law())));
  if (o.showPattern) {
    row.emplace_back(std::string(kPatternNames[static_cast<std::size_t>(o.plan.pattern)]));
  }
  const Moments& v = stats.value;
  row.insert(row.end(), {stats.trials(), exact, v.mean(), v.meanError(), v.variance(), v.varianceError(),
                         stats.lookupsPerTrial()});
  if (!o.lab.omitSeconds) row.emplace_back(stats.secondsPerTrial());
  row.emplace_back(v.variance() * stats.lookupsPerTrial());
  if (!o.lab.omitSeconds) row.emplace_back(v.variance() * stats.secondsPerTrial());
  row.emplace_back(stats.nonFinite);
  return row;
}

}  // namespace

LabTable estimateTable(EstimateOptions o, const StopSignal& stop) {
  o.problem.check();
  if (o.trials < 2) throw std::runtime_error("--trials: expected at least 2, for a variance");
  if (o.plan.samples < 1) throw std::runtime_error("--samples-per-estimate: expected at least 1");
  std::vector<LabTable::Skipped> skipped;
  const std::vector<LabEstimator> estimators = o.selection.select(skipped);
  // Where the exact values are not all those of the exponential law, the rows say whose they are.
  o.showLaw = o.showLaw || std::any_of(estimators.begin(), estimators.end(), [](const LabEstimator& one) {
                return one.quantity() == Quantity::Transmittance &&
                       !std::holds_alternative<ExponentialLaw>(one.law());
              });
  LabTable table(o.lab.command, columnsOf(o));
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  noteQuantity(table, estimators);
  const std::vector<CanonicalFunction> functions = o.functions.select();
  std::size_t total = 0, done = 0;
  for (const CanonicalFunction& f : functions)
    total += estimators.size() * problemChoices(o.problem, f).size();
  TrialJournal journal(o.lab.resume, o.lab.identity);
  LabProgress progress("medialab estimate", total, o.lab.quiet);
  for (const LabEstimator& estimator : estimators) {
    for (const CanonicalFunction& function : functions) {
      std::set<std::string> told;
      for (const ProblemChoice& choice : problemChoices(o.problem, function)) {
        const LabProblem problem = makeProblem(o.problem, function, choice);
        const std::string whyNot = whyNotApplicable(estimator, problem.line);
        if (!whyNot.empty()) {
          if (told.insert(whyNot).second)
            table.skip(estimator.label() + " on " + function.about().name, whyNot);
          ++done;
          continue;
        }
        const std::uint64_t seed = rowSeed(o.lab.seed, estimator.label(), function.about().name, choice);
        const TrialStats stats = journal.recall(seed, stop.flag(), [&] {
          return runTrialsInParallel(estimator, problem, o.plan, seed, o.trials, stop.flag());
        });
        if (stop) {
          table.markStopped();
          return table;
        }
        table.add(rowOf(o, estimator, function, choice, problem.exact(estimator), stats));
        progress.update(++done, estimator.label() + " on " + function.about().name);
      }
    }
  }
  return table;
}

int runEstimate(const EstimateOptions& options) {
  checkOutput(options.lab);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  const LabTable table = estimateTable(options, stop);
  if (table.rows().empty() && !stop) {
    std::string why = "nothing could be run";
    for (const auto& s : table.skipped()) why += "\n  " + s.what + ": " + s.reason;
    throw std::runtime_error(why);
  }
  writeTable(table, options.lab);
  return 0;
}

}  // namespace pbrtmedia
