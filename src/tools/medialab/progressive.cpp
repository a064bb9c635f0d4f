// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/progressive.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "tools/medialab/moments.h"

namespace pbrtmedia {
namespace {

/// What all sequences tell of one pass.
struct PassMoments {
  Moments pass;     ///< mean of the pass's estimates
  Moments average;  ///< of all passes so far
  Moments square;   ///< (average - exact)^2
  Moments lookups, bounded, depth;

  void add(const PassMoments& o) {
    pass.add(o.pass);
    average.add(o.average);
    square.add(o.square);
    lookups.add(o.lookups);
    bounded.add(o.bounded);
    depth.add(o.depth);
  }
};

/// The controls of one sequence, in the unit of the line's density.
class RisingBounds {
 public:
  RisingBounds(const ProgressiveOptions& o, const LabProblem& problem)
      : o_(o),
        sigmaT_(problem.sigmaT),
        whole_(problem.line),
        uppers_(problem.line.intervals().size(), o.start / problem.sigmaT),
        proposed_(uppers_) {}

  std::span<const double> uppers() const { return uppers_; }
  /// A look-up at s, whatever it was cut to.
  void find(double s) {
    if (o_.update != BoundsUpdate::Learned) return;
    double& proposed = proposed_[whole_.intervalAt(s)];
    proposed = std::max(proposed, whole_.density(s) + o_.epsilon / sigmaT_);
  }
  /// Ends the pass: what was proposed holds from now on.
  void publish() {
    if (o_.update == BoundsUpdate::Rising) {
      for (double& upper : proposed_) {
        upper = std::max(upper, std::min(upper + o_.rise / sigmaT_, o_.most / sigmaT_));
      }
    }
    uppers_ = proposed_;
  }
  /// Share of the intervals whose control is a bound; the line's own are tight.
  double boundedShare() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < uppers_.size(); ++i) count += uppers_[i] >= whole_.intervals()[i].bound.upper;
    return static_cast<double>(count) / static_cast<double>(uppers_.size());
  }

 private:
  const ProgressiveOptions& o_;
  double sigmaT_;
  const CanonicalLine& whole_;
  std::vector<double> uppers_, proposed_;
};

std::vector<PassMoments> runSequence(const ProgressiveOptions& o, const LabEstimator& estimator,
                                     const LabProblem& problem, std::uint64_t seed) {
  RisingBounds bounds(o, problem);
  std::vector<PassMoments> passes(o.passes);
  double sum = 0;
  const double exact = problem.exact(estimator);
  for (unsigned k = 0; k < o.passes; ++k) {
    LabProblem seen = problem;
    seen.line.setUppers(bounds.uppers(), !o.isUnclamped);
    double ofPass = 0, lookups = 0;
    for (unsigned i = 0; i < o.perPass; ++i) {
      const RecordedEstimate estimate = recordEstimate(estimator, seen, hashCombine(seed, k, i));
      ofPass += estimate.value / o.perPass;
      lookups += static_cast<double>(estimate.points.size());
      for (const double s : estimate.points) bounds.find(s);
    }
    sum += ofPass;
    const double average = sum / (k + 1);
    passes[k].pass.add(ofPass);
    passes[k].average.add(average);
    passes[k].square.add((average - exact) * (average - exact));
    passes[k].lookups.add(lookups);
    passes[k].bounded.add(bounds.boundedShare());
    passes[k].depth.add(seen.controlDepth());
    bounds.publish();
  }
  return passes;
}

}  // namespace

LabTable progressiveTable(const ProgressiveOptions& o, const StopSignal& stop) {
  o.problem.check();
  LabTable table(o.lab.command,
                 {"estimator", "extinction", "pass", "repeats", "exact", "pass_mean", "pass_mean_stderr",
                  "mean", "mean_stderr", "mse", "mse_stderr", "lookups", "bounded_share", "control_depth"});
  std::vector<LabTable::Skipped> skipped;
  const std::vector<LabEstimator> estimators = o.selection.select(skipped);
  noteQuantity(table, estimators);
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  const CanonicalFunction function = o.function.select().front();
  const ProblemChoice choice{o.problem.depths.front(), 1, 0};
  const LabProblem problem = makeProblem(o.problem, function, choice);
  if (!(problem.sigmaT > 0))
    throw std::runtime_error("--depth: expected a number above 0, nothing is to be learned");
  for (const LabEstimator& estimator : estimators) {
    if (const std::string why = whyNotApplicable(estimator, problem.line); !why.empty()) {
      table.skip(estimator.label(), why);
      continue;
    }
    const std::uint64_t seed = rowSeed(o.lab.seed, estimator.label(), function.about().name, choice);
    std::vector<std::vector<PassMoments>> sequences(o.repeats);
    parallelFor(sequences.size(), [&](std::size_t r) {
      if (!stop) sequences[r] = runSequence(o, estimator, problem, hashCombine(seed, r));
    });
    if (stop) {
      table.markStopped();
      return table;
    }
    for (unsigned k = 0; k < o.passes; ++k) {
      PassMoments all;
      for (const auto& sequence : sequences) all.add(sequence[k]);
      table.add({estimator.label(), function.about().name, std::uint64_t{k} + 1, std::uint64_t{o.repeats},
                 problem.exact(estimator), all.pass.mean(), all.pass.meanError(), all.average.mean(),
                 all.average.meanError(), all.square.mean(), all.square.meanError(), all.lookups.mean(),
                 all.bounded.mean(), all.depth.mean()});
    }
  }
  return table;
}

int runProgressive(const ProgressiveOptions& options) {
  checkOutput(options.lab);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  const LabTable table = progressiveTable(options, stop);
  if (table.rows().empty() && !stop) throw std::runtime_error("nothing could be run");
  writeTable(table, options.lab);
  return 0;
}

}  // namespace pbrtmedia
