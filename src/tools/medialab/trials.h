// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <string>

#include "fields/canonical_line.h"
#include "tools/medialab/estimator.h"
#include "tools/medialab/moments.h"
#include "transmittance/sampling_pattern.h"

namespace pbrtmedia {

/// A trial is the mean of `samples` estimates that share one sampling pattern.
struct TrialPlan {
  std::uint32_t samples = 1;
  PatternKind pattern = PatternKind::Independent;
};

/// When a run ends: at the first trial after which either number is reached.
struct TrialLimit {
  std::uint64_t trials = 1;
  std::uint64_t lookups = std::numeric_limits<std::uint64_t>::max();
};

/// What came out of a number of trials.
struct TrialStats {
  Moments value;                                           ///< of the trials that were finite
  std::uint64_t nonFinite = 0;                             ///< trials that were not
  std::uint64_t lookups = 0;                               ///< of all trials
  std::uint64_t estimates = 0;                             ///< trials times samples
  std::uint64_t violations = 0;                            ///< look-ups above their bound
  std::uint64_t capped = 0;                                ///< estimates that a limit on look-ups cut short
  std::uint64_t mostLookups = 0;                           ///< of one estimate
  double least = std::numeric_limits<double>::infinity();  ///< of the finite estimates
  double most = -std::numeric_limits<double>::infinity();
  double largestDeviation = 0;  ///< |trial - expected| at most
  double seconds = 0;           ///< of this thread's processor

  std::uint64_t trials() const { return value.count() + nonFinite; }
  double lookupsPerTrial() const { return static_cast<double>(lookups) / static_cast<double>(trials()); }
  double secondsPerTrial() const { return seconds / static_cast<double>(trials()); }
  void add(const TrialStats& o);
};

/// A problem to estimate: a line and the extinction that turns its density integral into optical depth.
struct LabProblem {
  CanonicalLine line;
  double sigmaT = 0;  ///< >= 0, finite

  double depth() const { return sigmaT * line.integral(); }
  double controlDepth() const { return sigmaT * line.upperIntegral(); }
  /// What the estimator's mean should be.
  double exact(const LabEstimator& estimator) const { return answerAt(estimator, depth()); }
};

/// Why the estimator has no answer on this line; empty when it has.
std::string whyNotApplicable(const LabEstimator& estimator, const CanonicalLine& line);

/// Trials one after the other on this thread; numbers follow from the seed alone. The estimator is
/// applicable.
TrialStats runTrials(const LabEstimator& estimator, const LabProblem& problem, const TrialPlan& plan,
                     std::uint64_t seed, const TrialLimit& limit);

/// `count` trials in chunks on all threads, chunk i seeded by (seed, i) and joined in order, so the numbers
/// do not depend on threads. Once `stop` is set no further chunk begins: the result has fewer trials then.
TrialStats runTrialsInParallel(const LabEstimator& estimator, const LabProblem& problem,
                               const TrialPlan& plan, std::uint64_t seed, std::uint64_t count,
                               const std::atomic<bool>& stop);

/// The points where one estimate looked at the density, in order, and its value.
struct RecordedEstimate {
  double value = 0;
  std::vector<double> points;
};
RecordedEstimate recordEstimate(const LabEstimator& estimator, const LabProblem& problem, std::uint64_t seed);

}  // namespace pbrtmedia
