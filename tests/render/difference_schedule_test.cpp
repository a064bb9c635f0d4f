// SPDX-License-Identifier: BSD-2-Clause
#include "render/difference_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "support/statistics.h"

namespace pbrtmedia::test {
namespace {

using Difference = DifferenceSchedule::Difference;
using Debias = DifferenceSchedule::Debias;
using Function = std::function<double(double)>;

double estimate(const DifferenceSchedule& schedule, std::int64_t pass, const Function& f) {
  double sum = 0;
  for (const DifferenceTerm& term : schedule.terms(pass)) sum += term.factor * f(term.value);
  return sum;
}

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

TEST(DifferenceSchedule, TakesOneDifferenceWithoutDebiasing) {
  const DifferenceSchedule forward({.value = .5, .step = .25});
  EXPECT_EQ(forward.terms(0), (std::vector<DifferenceTerm>{{.75, 4}, {.5, -4}}));
  EXPECT_EQ(forward.terms(7), forward.terms(0));
  const DifferenceSchedule central({.value = .5, .step = .25, .difference = Difference::Central});
  EXPECT_EQ(central.terms(3), (std::vector<DifferenceTerm>{{.75, 2}, {.25, -2}}));
  const DifferenceSchedule backward({.value = .5, .step = -.25});
  EXPECT_EQ(backward.terms(0), (std::vector<DifferenceTerm>{{.25, -4}, {.5, 4}}));
}

/// Its bias is h / 2 f'' and h^2 / 6 f'''.
TEST(DifferenceSchedule, HasTheBiasOfItsStep) {
  const DifferenceSchedule forward({.value = .7, .step = .01});
  EXPECT_NEAR(estimate(forward, 0, square), 2 * .7 + .01, 1e-7);
  const DifferenceSchedule central({.value = .7, .step = .01, .difference = Difference::Central});
  EXPECT_NEAR(estimate(central, 0, square), 2 * .7, 1e-7);
  EXPECT_NEAR(estimate(central, 0, cube), 3 * .7 * .7 + 1e-4, 1e-7);
}

/// Divided by the step between the numbers of single precision, not by the one that was asked for: at 1000
/// a step of 0.001 is 0.00097656.
TEST(DifferenceSchedule, KnowsTheStepBetweenRoundedValues) {
  const DifferenceSchedule schedule({.value = 1000, .step = .001});
  EXPECT_NEAR(estimate(schedule, 0, [](double x) { return 3 * x; }), 3, 1e-9);
  for (const DifferenceTerm& term : schedule.terms(0))
    EXPECT_EQ(term.value, static_cast<double>(static_cast<float>(term.value)));
}

/// Where corrections fall exactly as the probabilities of their levels, a debiased estimate has no noise.
TEST(DifferenceSchedule, CorrectsEveryLevelToTheTruth) {
  const DifferenceSchedule forward({.value = .75, .step = .125, .debias = Debias::Single, .seed = 1}),
      central({.value = .75,
               .step = .125,
               .difference = Difference::Central,
               .debias = Debias::Single,
               .seed = 2});
  EXPECT_EQ(forward.levels(), DifferenceSchedule::kMostLevels);
  int missed = 0;
  for (std::int64_t pass = 0; pass < 1000; ++pass) {
    if (forward.terms(pass).size() == 2) {  // none of the levels
      ++missed;
    } else {
      EXPECT_NEAR(estimate(forward, pass, square), 1.5, 1e-7) << pass;
    }
    if (central.terms(pass).size() > 2) {
      EXPECT_NEAR(estimate(central, pass, cube), 3 * .5625, 1e-7) << pass;
    }
  }
  EXPECT_LE(missed, 6) << "2^-10 of 1000";
}

RunningStats estimates(const DifferenceSchedule& schedule, const Function& f, std::int64_t passes) {
  RunningStats all;
  for (std::int64_t pass = 0; pass < passes; ++pass) all.add(estimate(schedule, pass, f));
  return all;
}

TEST(DifferenceSchedule, HasTheDerivativeForItsMean) {
  const Function f = [](double x) { return std::exp(2 * x); };
  const double truth = 2 * std::exp(1.0);
  for (const Difference difference : {Difference::Forward, Difference::Central}) {
    const DifferenceSchedule single(
        {.value = .5, .step = .2, .difference = difference, .debias = Debias::Single, .seed = 3});
    const ZTest test = zTest(estimates(single, f, 40000), truth, 3);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
    EXPECT_TRUE(test.sees(.001)) << test;
    const DifferenceSchedule none({.value = .5, .step = .2, .difference = difference});
    EXPECT_GT(std::abs(estimate(none, 0, f) - truth), kMaxAbsZ * test.standardError)
        << "that of one step would be seen";
  }
}

TEST(DifferenceSchedule, ShrinksProgressiveSteps) {
  const DifferenceSchedule schedule({.value = .5, .step = .1, .debias = Debias::Progressive, .decay = .5});
  for (const std::int64_t pass : {0, 3, 99}) {
    const std::vector<DifferenceTerm> terms = schedule.terms(pass);
    ASSERT_EQ(terms.size(), 2u);
    EXPECT_NEAR(terms[0].value - .5, .1 / std::sqrt(static_cast<double>(pass) + 1), 1e-7);
  }
  // To an end, which single precision sets.
  EXPECT_NEAR(schedule.terms(std::int64_t{1} << 50)[0].value - .5, DifferenceSchedule::kLeastUnits * 0x1p-24,
              1e-9);
}

TEST(DifferenceSchedule, HasFewerLevelsWhereNumbersAreCoarse) {
  const auto levels = [](double value, double step) {
    return DifferenceSchedule({.value = value, .step = step, .debias = Debias::Single}).levels();
  };
  EXPECT_EQ(levels(0, .01), 10u);
  EXPECT_EQ(levels(1000, .01), 1u);  // units of 2^-14: 64 of them are 0.0039
  EXPECT_EQ(levels(1000, .001), 0u);
}

TEST(DifferenceSchedule, RefusesStepsThatAreLost) {
  const auto problem = [](double value, double step) -> std::string {
    try {
      const DifferenceSchedule schedule({.value = value, .step = step});
      return "";
    } catch (const SceneError& e) {
      return e.what();
    }
  };
  EXPECT_NE(problem(1, 0).find("a step of 0 from 1 is lost"), std::string::npos) << problem(1, 0);
  EXPECT_NE(problem(1000, 1e-6).find("expected at least 0.00390625"), std::string::npos)
      << problem(1000, 1e-6);
  EXPECT_NE(problem(3e38, 1e38).find("leaves the numbers"), std::string::npos);
  EXPECT_EQ(problem(1, 1e-6), "");
}

}  // namespace
}  // namespace pbrtmedia::test
