// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/converge.h"

#include <cmath>
#include <stdexcept>

#include "base/hash.h"
#include "base/parallel.h"
#include "tools/medialab/fit.h"
#include "tools/medialab/journal.h"

namespace pbrtmedia {
namespace {

struct Point {
  std::uint32_t samples;
  TrialStats stats;
  double meanSquare, meanSquareError;

  double rmse() const { return std::sqrt(meanSquare); }
  double rmseError() const { return meanSquare > 0 ? meanSquareError / (2 * rmse()) : 0; }
};

/// E[(x - exact)^2] from mean and variance, with the error that the fourth moment gives it; the bias' own
/// part of that error is added in full.
Point pointOf(std::uint32_t samples, const TrialStats& stats, double exact) {
  const Moments& v = stats.value;
  const double n = static_cast<double>(v.count()), bias = v.mean() - exact;
  const double square = v.variance() * (n - 1) / n + bias * bias;
  return {samples, stats, square, std::hypot(v.varianceError(), 2 * bias * v.meanError())};
}

LogSlope slopeOver(const std::vector<Point>& curve, double (*abscissa)(const Point&)) {
  std::vector<LogPoint> points;
  for (const Point& p : curve) points.push_back({abscissa(p), p.rmse(), p.rmseError()});
  return fitLogSlope(points);
}

/// The result in a line.
std::string slopeNote(const std::string& estimator, const CanonicalFunction& function,
                      const ProblemChoice& choice, const LogSlope& bySamples, const LogSlope& byLookups) {
  const auto rounded = [](double x) { return formatNumber(std::round(1000 * x) / 1000); };
  std::string text = estimator + " on " + function.about().name + ", depth " + formatNumber(choice.depth);
  text += ", control " + formatNumber(choice.control) + ": rmse ~ samples^" + rounded(bySamples.slope);
  text += " +- " + rounded(bySamples.error) + ", ~ look-ups^" + rounded(byLookups.slope) + " +- ";
  return text + rounded(byLookups.error);
}

/// One estimator on one line, measured with more and more samples.
struct Curve {
  const LabEstimator& estimator;
  const CanonicalFunction& function;
  const ProblemChoice& choice;
  double exact;  ///< transmittance
  std::vector<Point> points{};

  std::string name() const { return estimator.label() + " on " + function.about().name; }
};

LabTable emptyTable(const ConvergeOptions& o) {
  std::vector<std::string> columns{"estimator",     "extinction",
                                   "depth",         "control",
                                   "pattern",       "samples",
                                   "trials",        "lookups",
                                   "rmse",          "rmse_stderr",
                                   "bias",          "bias_stderr",
                                   "slope_samples", "slope_samples_stderr",
                                   "slope_lookups", "slope_lookups_stderr"};
  if (!o.lab.omitSeconds) {
    columns.insert(columns.end(), {"seconds", "slope_seconds", "slope_seconds_stderr"});
  }
  columns.emplace_back("non_finite");
  return {o.lab.command, columns};
}

/// Doubles the samples until the last, or until somebody stops it; calls `onPoint` after each.
template <class OnPoint>
void measure(Curve& curve, const LabProblem& problem, const ConvergeOptions& o, TrialJournal& journal,
             const StopSignal& stop, const OnPoint& onPoint) {
  const std::uint64_t seed =
      rowSeed(o.lab.seed, curve.estimator.label(), curve.function.about().name, curve.choice);
  for (unsigned d = 0; d <= o.doublings; ++d) {
    const std::uint32_t samples = 1u << d;
    const std::uint64_t own = hashCombine(seed, d);
    const TrialStats stats = journal.recall(own, stop.flag(), [&] {
      return runTrialsInParallel(curve.estimator, problem, {.samples = samples, .pattern = o.pattern}, own,
                                 o.trials, stop.flag());
    });
    if (stop) return;
    curve.points.push_back(pointOf(samples, stats, curve.exact));
    onPoint();
  }
}

void addRows(LabTable& table, const Curve& curve, const ConvergeOptions& o) {
  const auto over = [&](double (*abscissa)(const Point&)) { return slopeOver(curve.points, abscissa); };
  const LogSlope bySamples = over([](const Point& p) { return static_cast<double>(p.samples); });
  const LogSlope byLookups = over([](const Point& p) { return p.stats.lookupsPerTrial(); });
  const LogSlope bySeconds = over([](const Point& p) { return p.stats.secondsPerTrial(); });
  table.note(slopeNote(curve.estimator.label(), curve.function, curve.choice, bySamples, byLookups));
  for (const Point& p : curve.points) {
    const Moments& v = p.stats.value;
    std::vector<LabTable::Cell> row{curve.estimator.label(),
                                    curve.function.about().name,
                                    curve.choice.depth,
                                    curve.choice.control,
                                    std::string(kPatternNames[static_cast<std::size_t>(o.pattern)]),
                                    std::uint64_t{p.samples},
                                    p.stats.trials(),
                                    p.stats.lookupsPerTrial(),
                                    p.rmse(),
                                    p.rmseError(),
                                    v.mean() - curve.exact,
                                    v.meanError(),
                                    bySamples.slope,
                                    bySamples.error,
                                    byLookups.slope,
                                    byLookups.error};
    if (!o.lab.omitSeconds) {
      row.insert(row.end(), {p.stats.secondsPerTrial(), bySeconds.slope, bySeconds.error});
    }
    row.emplace_back(p.stats.nonFinite);
    table.add(std::move(row));
  }
}

}  // namespace

LabTable convergeTable(const ConvergeOptions& o, const StopSignal& stop) {
  o.problem.check();
  if (o.trials < 4) throw std::runtime_error("--trials: expected at least 4");
  if (o.doublings < 1 || o.doublings > 24) throw std::runtime_error("--doublings: expected 1 to 24");
  LabTable table = emptyTable(o);
  std::vector<LabTable::Skipped> skipped;
  const std::vector<LabEstimator> estimators = o.selection.select(skipped);
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  noteQuantity(table, estimators);
  const std::vector<CanonicalFunction> functions = o.functions.select();
  std::size_t total = 0, done = 0;
  for (const auto& f : functions) total += estimators.size() * problemChoices(o.problem, f).size();
  total *= o.doublings + 1;
  TrialJournal journal(o.lab.resume, o.lab.identity);
  LabProgress progress("medialab converge", total, o.lab.quiet);
  for (const LabEstimator& estimator : estimators) {
    for (const CanonicalFunction& function : functions) {
      for (const ProblemChoice& choice : problemChoices(o.problem, function)) {
        const LabProblem problem = makeProblem(o.problem, function, choice);
        Curve curve{estimator, function, choice, problem.exact(estimator)};
        if (const std::string why = whyNotApplicable(estimator, problem.line); !why.empty()) {
          table.skip(curve.name(), why);
          done += o.doublings + 1;
          continue;
        }
        measure(curve, problem, o, journal, stop, [&] { progress.update(++done, curve.name()); });
        addRows(table, curve, o);
        if (stop) {
          table.markStopped();
          return table;
        }
      }
    }
  }
  return table;
}

int runConverge(const ConvergeOptions& options) {
  checkOutput(options.lab);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  const LabTable table = convergeTable(options, stop);
  if (table.rows().empty() && !stop) throw std::runtime_error("nothing could be run");
  writeTable(table, options.lab);
  return 0;
}

}  // namespace pbrtmedia
