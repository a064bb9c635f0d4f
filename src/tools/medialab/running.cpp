// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/running.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "tools/medialab/moments.h"

namespace pbrtmedia {
namespace {

/// The part of the line up to s.
LabProblem cutAt(const LabProblem& whole, double s) {
  CanonicalLine::Setup setup = whole.line.setup();
  setup.end = s;
  return {CanonicalLine(whole.line.function(), setup), whole.sigmaT};
}

/// All runs at one s, in their order.
std::vector<double> valuesAt(const LabEstimator& estimator, const LabProblem& part, std::uint64_t seed,
                             unsigned runs) {
  std::vector<double> values(runs);
  for (unsigned run = 0; run < runs; ++run) {
    values[run] = recordEstimate(estimator, part, hashCombine(seed, run)).value;
  }
  return values;
}

}  // namespace

LabTable runningTable(const RunningOptions& o, const StopSignal& stop) {
  o.problem.check();
  LabTable table(o.lab.command, {"estimator", "extinction", "s", "run", "value"});
  std::vector<LabTable::Skipped> skipped;
  const std::vector<LabEstimator> estimators = o.selection.select(skipped);
  noteQuantity(table, estimators);
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  const CanonicalFunction function = o.function.select().front();
  const std::string name = function.about().name;
  const ProblemChoice choice = problemChoices(o.problem, function).front();
  const LabProblem whole = makeProblem(o.problem, function, choice);
  const double end = o.to > 0 ? std::min(o.to, whole.line.length()) : whole.line.length();
  for (const LabEstimator& estimator : estimators) {
    if (const std::string why = whyNotApplicable(estimator, whole.line); !why.empty()) {
      table.skip(estimator.label(), why);
      continue;
    }
    const std::uint64_t seed = rowSeed(o.lab.seed, estimator.label(), name, choice);
    std::vector<std::vector<double>> values(o.points);
    parallelFor(values.size(), [&](std::size_t i) {
      if (stop) return;
      const double s = end * static_cast<double>(i + 1) / o.points;
      values[i] = valuesAt(estimator, cutAt(whole, s), seed, o.runs);
    });
    if (stop) {
      table.markStopped();
      return table;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double s = end * static_cast<double>(i + 1) / o.points;
      const auto add = [&](const std::string& run, double value) {
        table.add({estimator.label(), name, s, run, value});
      };
      Moments all;
      for (const double value : values[i]) all.add(value);
      add("exact", cutAt(whole, s).exact(estimator));
      add("mean", all.mean());
      add("stderr", all.meanError());
      for (unsigned run = 0; run < std::min(o.curves, o.runs); ++run)
        add(std::to_string(run), values[i][run]);
    }
  }
  return table;
}

int runRunning(const RunningOptions& options) {
  checkOutput(options.lab);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  const LabTable table = runningTable(options, stop);
  if (table.rows().empty() && !stop) throw std::runtime_error("nothing could be run");
  writeTable(table, options.lab);
  return 0;
}

}  // namespace pbrtmedia
