// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/trials.h"

#include <ctime>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "samplers/keys.h"
#include "transmittance/estimator_list.h"
#include "transmittance/sample_stream.h"

// The one file that compiles every estimator on the lab's line.

namespace pbrtmedia {
namespace {

/// Calls `f` with the concrete estimator, of either quantity.
template <class F>
decltype(auto) visitHeld(F&& f, const LabEstimator& estimator) {
  if (const AnyReciprocal* const reciprocal = std::get_if<AnyReciprocal>(&estimator.held())) {
    return std::visit(std::forward<F>(f), *reciprocal);
  }
  return visitEstimator(std::forward<F>(f), std::get<AnyEstimator>(estimator.held()));
}

double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Trials in a chunk: enough that starting one costs nothing, few enough to stop soon.
constexpr std::uint64_t kChunkTrials = 512;

class TrialRunner {
 public:
  TrialRunner(const LabProblem& problem, const TrialPlan& plan, std::uint64_t seed)
      : problem_(problem), plan_(plan), seed_(seed), rng_(seed), expectation_(0) {}

  template <class Estimator>
  TrialStats run(const Estimator& estimator, const TrialLimit& limit, double expected) {
    expectation_ = expected;
    const double begin = threadSeconds();
    while (stats_.trials() < limit.trials && stats_.lookups < limit.lookups) oneTrial(estimator);
    stats_.seconds = threadSeconds() - begin;
    return stats_;
  }

 private:
  template <class Estimator>
  void oneTrial(const Estimator& estimator) {
    double sum = 0;
    if (plan_.pattern == PatternKind::Independent) {
      SampleStream stream(rng_);
      for (std::uint32_t i = 0; i < plan_.samples; ++i) sum += oneEstimate(estimator, stream);
    } else {
      const SamplingPattern pattern(plan_.pattern, plan_.samples, subKey(seed_, stats_.trials() + 1));
      for (std::uint32_t i = 0; i < plan_.samples; ++i) {
        SampleStream stream(rng_, pattern, i);
        sum += oneEstimate(estimator, stream);
      }
    }
    const double value = sum / plan_.samples;
    if (!std::isfinite(value)) {
      ++stats_.nonFinite;
      return;
    }
    stats_.value.add(value);
    stats_.largestDeviation = std::max(stats_.largestDeviation, std::abs(value - expectation_));
  }
  template <class Estimator>
  double oneEstimate(const Estimator& estimator, SampleStream& stream) {
    const Estimate<1> estimate = estimator(problem_.line, Channels<1>{problem_.sigmaT}, stream);
    const LookupTally& tally = estimate.tally;
    ++stats_.estimates;
    stats_.lookups += tally.lookups;
    stats_.violations += tally.violations;
    stats_.capped += tally.capped;
    stats_.mostLookups = std::max(stats_.mostLookups, tally.lookups);
    const double value = estimate.value[0];
    if (std::isfinite(value)) {
      stats_.least = std::min(stats_.least, value);
      stats_.most = std::max(stats_.most, value);
    }
    return value;
  }

  const LabProblem& problem_;
  TrialPlan plan_;
  std::uint64_t seed_;
  Rng rng_;
  double expectation_;
  TrialStats stats_;
};

}  // namespace

void TrialStats::add(const TrialStats& o) {
  value.add(o.value);
  nonFinite += o.nonFinite;
  lookups += o.lookups;
  estimates += o.estimates;
  violations += o.violations;
  capped += o.capped;
  mostLookups = std::max(mostLookups, o.mostLookups);
  least = std::min(least, o.least);
  most = std::max(most, o.most);
  largestDeviation = std::max(largestDeviation, o.largestDeviation);
  seconds += o.seconds;
}

std::string whyNotApplicable(const LabEstimator& estimator, const CanonicalLine& line) {
  const bool needsPieces = estimator.quantity() == Quantity::Transmittance && estimator.traits().needsPieces;
  if (needsPieces && !line.isPiecewiseCubic()) {
    return "needs a density that is a cubic between known points, which " + line.function().about().name +
           " is not";
  }
  return "";
}

TrialStats runTrials(const LabEstimator& estimator, const LabProblem& problem, const TrialPlan& plan,
                     std::uint64_t seed, const TrialLimit& limit) {
  const double expected = problem.exact(estimator);
  return visitHeld(
      [&](const auto& held) { return TrialRunner(problem, plan, seed).run(held, limit, expected); },
      estimator);
}

TrialStats runTrialsInParallel(const LabEstimator& estimator, const LabProblem& problem,
                               const TrialPlan& plan, std::uint64_t seed, std::uint64_t count,
                               const std::atomic<bool>& stop) {
  const std::uint64_t perChunk = std::max<std::uint64_t>(1, kChunkTrials / plan.samples);
  std::vector<TrialStats> chunks(static_cast<std::size_t>((count + perChunk - 1) / perChunk));
  parallelFor(chunks.size(), [&](std::size_t i) {
    if (stop) return;
    const std::uint64_t trials = std::min(perChunk, count - i * perChunk);
    chunks[i] = runTrials(estimator, problem, plan, hashCombine(seed, i), {.trials = trials});
  });
  TrialStats all;
  for (const TrialStats& chunk : chunks) all.add(chunk);
  return all;
}

RecordedEstimate recordEstimate(const LabEstimator& estimator, const LabProblem& problem,
                                std::uint64_t seed) {
  RecordedEstimate recorded;
  CanonicalLine line = problem.line;
  line.record(&recorded.points);
  Rng rng(seed);
  SampleStream stream(rng);
  recorded.value = visitHeld(
      [&](const auto& held) { return held(line, Channels<1>{problem.sigmaT}, stream).value[0]; }, estimator);
  return recorded;
}

}  // namespace pbrtmedia
