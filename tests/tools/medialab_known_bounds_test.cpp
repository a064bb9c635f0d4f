// SPDX-License-Identifier: BSD-2-Clause
// What bounds that leave nothing open save, and where a product of exactly 0 ends a walk: exact numbers of
// look-ups, for every estimator of the list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tools/medialab/trials.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20261129;
constexpr std::uint64_t kTrials = 2000;
constexpr double kDepth = 1.5;

/// Lives as long as the program, as lines borrow their function.
const CanonicalFunction& named(std::string_view name) {
  static std::map<std::string_view, CanonicalFunction> known;
  const auto found = known.find(name);
  return found != known.end() ? found->second
                              : known.emplace(name, *findCanonicalFunction(name)).first->second;
}

LabProblem problemOn(const CanonicalFunction& function, const CanonicalLine::Setup& setup,
                     double depth = kDepth) {
  const CanonicalLine line(function, setup);
  const double integral = line.integral();
  return {line, integral > 0 ? depth / integral : 1};
}

bool isIn(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Estimators that integrate lower bounds.
bool usesLower(const std::string& name) {
  return isIn(name, {"residual-ratio", "residual-track-length", "p-series-residual", "random-medium"});
}
/// Estimators whose every look-up is a point of a process with the rate of the bound.
bool walksUnderBound(const std::string& name) {
  return isIn(name, {"ratio", "track-length", "adaptive-ratio", "johnson", "next-flight",
                     "unidirectional-mis", "bidirectional-mis", "p-series-ratio", "p-series-next-flight",
                     "p-series-cumulative", "p-series-cmf", "pink-p-cumulative"}) ||
         usesLower(name);
}

class KnownBounds : public testing::TestWithParam<std::string_view> {
 protected:
  LabEstimator estimator_{GetParam()};
  std::string name_{GetParam()};

  bool serves(const LabProblem& problem) const { return whyNotApplicable(estimator_, problem.line).empty(); }
  TrialStats trials(const LabProblem& problem) const {
    return runTrials(estimator_, problem, {}, kSeed, {.trials = kTrials});
  }
  double exact(const LabProblem& problem) const { return problem.exact(estimator_); }
};

TEST_P(KnownBounds, VacuumCostsNothing) {
  const CanonicalFunction nothing({"nothing", "0", "test"}, {{.end = 1}});
  for (const unsigned superVoxels : {1u, 7u, 96u}) {
    const LabProblem problem = problemOn(nothing, {.superVoxels = superVoxels});
    const TrialStats stats = trials(problem);
    // Regular tracking goes by pieces of the density, not by bounds.
    EXPECT_EQ(stats.lookups, name_ == "regular" ? 2 * kTrials : 0);
    EXPECT_EQ(stats.least, 1);
    EXPECT_EQ(stats.most, 1);
  }
}

TEST_P(KnownBounds, AConstantBetweenEqualBoundsCostsWhatTheControlsSay) {
  const CanonicalFunction& constant = named("constant");
  for (const unsigned superVoxels : {1u, 8u}) {
    const LabProblem problem = problemOn(constant, {.lower = 1, .superVoxels = superVoxels});
    const TrialStats stats = trials(problem);
    if (!usesLower(name_)) continue;
    EXPECT_EQ(stats.lookups, 0u) << "with " << superVoxels << " super-voxels";
    EXPECT_DOUBLE_EQ(stats.least, std::exp(-kDepth));
    EXPECT_EQ(stats.most, stats.least);
  }
}

/// Negative control: bounds that are not true are probed where they leave nothing open.
TEST_P(KnownBounds, UntrueOnesAreStillProbed) {
  const LabProblem blind = problemOn(named("cosine"), {.superVoxels = 8, .blind = 3});
  if (estimator_.traits().control == EstimatorTraits::Control::Unused || !serves(blind)) return;
  EXPECT_GT(trials(blind).violations, 0u);
}

TEST_P(KnownBounds, NoWalkLooksIntoEmptySuperVoxels) {
  for (const auto& [function, superVoxels] : {std::pair{"step", 8u}, {"piecewise-random", 96u}}) {
    const LabProblem problem = problemOn(named(function), {.superVoxels = superVoxels});
    if (!walksUnderBound(name_)) continue;
    std::size_t looked = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
      for (const double s : recordEstimate(estimator_, problem, seed).points) {
        ++looked;
        const auto intervals = problem.line.intervals();
        const auto at = std::find_if(intervals.begin(), intervals.end(),
                                     [&](const CanonicalLine::Interval& i) { return s < i.sExit; });
        // Explorers of random-medium lie where they lie.
        if (at != intervals.end() && name_ != "random-medium") {
          EXPECT_GT(at->bound.upper, 0) << s;
        }
      }
    }
    EXPECT_GT(looked, 0u) << "else nothing was tested";
  }
}

TEST_P(KnownBounds, ResidualsLookOnlyWhereBoundsDiffer) {
  // Bounds of a step are equal but in the two cells that meet at the jump, of which rounding may see both
  // sides.
  const LabProblem problem = problemOn(named("step"), {.lower = 1, .superVoxels = 8});
  if (!usesLower(name_)) return;
  double open = 0;
  for (const CanonicalLine::Interval& i : problem.line.intervals()) {
    if (i.bound.upper > i.bound.lower) open += (i.sExit - i.sEnter) * (i.bound.upper - i.bound.lower);
  }
  const TrialStats stats = trials(problem);
  const double most = problem.sigmaT * open + (name_ == "random-medium" ? 10 : 0);  // its explorers
  const double perTrial = static_cast<double>(stats.lookups) / kTrials;
  EXPECT_LE(perTrial, most + 5 * std::sqrt(most / kTrials));
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    for (const double s : recordEstimate(estimator_, problem, seed).points) {
      const auto intervals = problem.line.intervals();
      const auto at = std::find_if(intervals.begin(), intervals.end(),
                                   [&](const CanonicalLine::Interval& i) { return s <= i.sExit; });
      ASSERT_NE(at, intervals.end());
      EXPECT_GT(at->bound.upper, at->bound.lower) << s;
    }
  }
}

/// Densities whose reciprocal rounds, so that density * (1 / bound) is not 1.
std::vector<double> awkwardScales() {
  std::vector<double> scales;
  for (double scale = 0.001; scales.size() < 40; scale *= 1.37) {
    if (scale * (1 / scale) != 1) scales.push_back(scale);
  }
  return scales;
}

TEST_P(KnownBounds, ADensityThatIsItsBoundEndsTheWalk) {
  // Such points multiply by exactly 0, so nothing behind the first is looked at, and where it alone counts
  // the value is 0 or 1.
  if (!isIn(name_,
            {"ratio", "track-length", "adaptive-ratio", "next-flight", "unidirectional-mis", "p-series-ratio",
             "p-series-next-flight", "p-series-cumulative", "p-series-cmf", "pink-p-cumulative",
             "residual-ratio", "residual-track-length", "p-series-residual", "bidirectional-mis"})) {
    return;
  }
  const std::uint64_t most = name_ == "bidirectional-mis" ? 2 : 1;  // one for each end
  const bool isOneProduct = isIn(name_, {"ratio", "track-length", "p-series-ratio", "residual-ratio",
                                         "residual-track-length", "p-series-residual"});
  for (const double scale : awkwardScales()) {
    const LabProblem problem = problemOn(named("constant"), {.scale = scale}, 5);
    const TrialStats stats = runTrials(estimator_, problem, {}, kSeed, {.trials = 200});
    EXPECT_EQ(stats.mostLookups, most) << scale;
    if (!isOneProduct) continue;
    EXPECT_EQ(stats.least, 0) << scale;
    EXPECT_TRUE(stats.most == 0 || stats.most == 1) << scale;
  }
}

TEST_P(KnownBounds, WhatHasNoNoiseHasNoErrorBeyondRounding) {
  constexpr double kRoundings = 64 * std::numeric_limits<double>::epsilon();
  std::size_t tested = 0;
  for (const std::string_view function : canonicalFunctionNames()) {
    for (const unsigned superVoxels : {1u, 8u, 96u}) {
      const LabProblem problem = problemOn(named(function), {.lower = 1, .superVoxels = superVoxels});
      const bool hasNoNoise = name_ == "regular" || (usesLower(name_) && function == "constant");
      if (!hasNoNoise || !serves(problem)) continue;
      const TrialStats stats = runTrials(estimator_, problem, {}, kSeed, {.trials = 100});
      EXPECT_EQ(stats.least, stats.most) << function;
      // Optical depths carry the roundings of sums, which the law multiplies by the depth.
      EXPECT_NEAR(stats.least / exact(problem), 1, kRoundings * (1 + kDepth))
          << function << ' ' << superVoxels;
      ++tested;
    }
  }
  if (name_ == "regular" || usesLower(name_)) {
    EXPECT_GT(tested, 2u);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, KnownBounds, testing::ValuesIn(estimatorNames()),
                         [](const testing::TestParamInfo<std::string_view>& parameter) {
                           std::string name(parameter.param);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace pbrtmedia
