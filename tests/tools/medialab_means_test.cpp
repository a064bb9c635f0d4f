// SPDX-License-Identifier: BSD-2-Clause
// The mean of every estimator of the list on every function of the lab, from thin to thick, under controls
// that bound and controls that do not.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "tools/medialab/trials.h"
#include "tools/medialab/verdict.h"

namespace pbrtmedia {
namespace {

using Kind = StressVerdict::Kind;

constexpr std::uint64_t kSeed = 20241124;
constexpr TrialLimit kLimit{.trials = 4000, .lookups = 30000};

struct Cell {
  std::string function;
  double depth, control;
};

std::vector<Cell> allCells() {
  std::vector<Cell> cells;
  for (const std::string_view function : canonicalFunctionNames()) {
    for (const double depth : {.05, .5, 2.3, 6.}) {
      for (const double control : {1., 1.5, 5., .6, .9})
        cells.push_back({std::string(function), depth, control});
    }
  }
  return cells;
}

/// What the trials of one cell say about the mean; `shift` is added to the truth.
StressVerdict verdictOf(const LabEstimator& estimator, const Cell& cell, double shift) {
  const CanonicalFunction function = *findCanonicalFunction(cell.function);
  const CanonicalLine line(function, {.control = cell.control});
  const LabProblem problem{line, cell.depth / line.integral()};
  IsolatedResult result;
  result.end = IsolatedResult::End::Done;
  const std::uint64_t seed = hashCombine(hashCombine(kSeed, hashBytes(cell.function)),
                                         static_cast<std::uint64_t>(1000 * cell.depth + 10 * cell.control));
  result.stats = runTrials(estimator, problem, {}, seed, kLimit);
  return judge(estimator.traits(),
               {.exact = problem.exact(estimator) + shift,
                .depth = problem.depth(),
                .controlDepth = problem.controlDepth(),
                .control = cell.control,
                .isBounding = cell.control >= 1},
               result);
}

class MeansOfAll : public testing::TestWithParam<std::string_view> {
 protected:
  LabEstimator estimator_{GetParam()};

  /// Verdicts on all cells that the estimator serves.
  std::vector<StressVerdict> verdicts(const std::vector<Cell>& cells, double shift) const {
    std::vector<StressVerdict> all(cells.size());
    parallelFor(cells.size(), [&](std::size_t i) { all[i] = verdictOf(estimator_, cells[i], shift); });
    return all;
  }
  std::vector<Cell> servedCells() const {
    std::vector<Cell> cells = allCells();
    std::erase_if(cells, [&](const Cell& c) {
      return !whyNotApplicable(estimator_, CanonicalLine(*findCanonicalFunction(c.function), {})).empty();
    });
    return cells;
  }
};

TEST_P(MeansOfAll, AreTheTransmittance) {
  const std::vector<Cell> cells = servedCells();
  ASSERT_GE(cells.size(), 80u);
  const std::vector<StressVerdict> all = verdicts(cells, 0);
  std::size_t unclear = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_NE(all[i].kind, Kind::Fail) << cells[i].function << ", depth " << cells[i].depth << ", control "
                                       << cells[i].control << ": " << all[i].reason << ", z " << all[i].z;
    unclear += all[i].kind == Kind::Undecided ? 1 : 0;
  }
  EXPECT_LT(unclear, cells.size() / 4);
}

/// The same judgement finds a truth that is 0.1 off wherever the estimator claims to meet it.
TEST_P(MeansOfAll, AreNotSomethingElse) {
  const EstimatorTraits traits = estimator_.traits();
  if (traits.bias != EstimatorTraits::Bias::Unbiased || !traits.finiteVariance) GTEST_SKIP() << "not claimed";
  const Cell cell{"cosine", .5, 1.5};
  EXPECT_EQ(verdictOf(estimator_, cell, .1).kind, Kind::Fail);
}

INSTANTIATE_TEST_SUITE_P(Every, MeansOfAll, testing::ValuesIn(estimatorNames()),
                         [](const testing::TestParamInfo<std::string_view>& parameter) {
                           std::string name(parameter.param);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace pbrtmedia
