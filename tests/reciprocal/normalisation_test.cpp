// SPDX-License-Identifier: BSD-2-Clause
// What reciprocals are for: dividing by integrals and probabilities that only estimates or events tell.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "fields/canonical_line.h"
#include "reciprocal/any_reciprocal.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;
constexpr auto kNever = [] { return false; };

/// The mean of s under the pdf density / F of a line, F unknown: an estimate of the integral of s density,
/// times an independent one of 1/F.
TEST(Normalisation, OfADensityThatIsAPdfButForItsIntegral) {
  const CanonicalFunction function = *findCanonicalFunction("gaussian-m23");
  const CanonicalLine line(function, {.control = 1.2, .superVoxels = 4});
  constexpr int kPoints = 1 << 18;
  double numerator = 0, denominator = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double s = (i + .5) / kPoints, density = line.density(s);
    numerator += s * density / kPoints;
    denominator += density / kPoints;
  }
  const double truth = numerator / denominator;

  Rng rng(kSeed);
  RunningStats unbiased, naive;
  for (int i = 0; i < 40000; ++i) {
    SampleStream stream(rng);
    const double s = stream.uniform(), moment = s * line.density(s);
    unbiased.add(moment * ReciprocalPCumulative{}(line, Channels<1>{1}, stream).value[0]);
    const ReciprocalMarch march{.n = 2, .comb = Comb::Independent};
    naive.add(moment * march(line, Channels<1>{1}, stream).value[0]);
  }
  EXPECT_LT(std::abs(zTest(unbiased, truth).z()), kMaxAbsZ) << zTest(unbiased, truth, kSeed);
  EXPECT_GT(zTest(naive, truth).z(), 10) << zTest(naive, truth, kSeed);
}

/// A random process that ends in one of a few solutions with probabilities nobody knows, as Newton's method
/// from random points does on specular chains: the sum of what solutions contribute, each found weighed by 1
/// / probability that the same process finds it again.
class Process {
 public:
  static constexpr std::array kProbability{.55, .25, .15, .05};
  static constexpr std::array kContribution{1., 3., .5, 8.};

  static std::size_t run(SampleStream& stream) {
    double u = stream.uniform();
    for (std::size_t k = 0; k + 1 < kProbability.size(); ++k) {
      if ((u -= kProbability[k]) < 0) return k;
    }
    return kProbability.size() - 1;
  }
};

TEST(Normalisation, OfSolutionsByTheTrialsThatFindThemAgain) {
  Rng rng(kSeed);
  RunningStats byTrials, bySeries, unweighted;
  double sum = 0, variance = 0;
  for (std::size_t k = 0; k < Process::kProbability.size(); ++k) {
    const double c = Process::kContribution[k], p = Process::kProbability[k];
    sum += c;
    variance += p * c * c * (2 - p) / (p * p);
  }
  variance -= sum * sum;
  for (int i = 0; i < 100000; ++i) {
    SampleStream stream(rng);
    const std::size_t found = Process::run(stream);
    const auto again = [&] { return Process::run(stream) == found; };
    const double contribution = Process::kContribution[found];
    byTrials.add(contribution * trialsReciprocal(1, again, kNever));
    // The same by a series whose factors are the share of failures among three trials.
    const auto failures = [&] {
      double count = 0;
      for (int trial = 0; trial < 3; ++trial) count += again() ? 0 : 1;
      return count / 3;
    };
    bySeries.add(contribution * cumulativeReciprocal(1, stream, failures, kNever));
    unweighted.add(contribution);
  }
  for (const RunningStats& values : {byTrials, bySeries}) {
    EXPECT_LT(std::abs(zTest(values, sum).z()), kMaxAbsZ) << zTest(values, sum, kSeed);
    EXPECT_NEAR(values.variance(), variance, .05 * variance);
  }
  EXPECT_GT(std::abs(zTest(unweighted, sum).z()), kMaxAbsZ);
}

/// A pdf that is itself an integral: p(x) = mean over y of p(x | y). Estimates of p(x) at random y serve the
/// Taylor series; the pivot is any number above half of them.
TEST(Normalisation, OfAMarginalPdfByEstimatesOfIt) {
  Rng rng(kSeed);
  RunningStats values;
  const ReciprocalTaylor::Orders orders{{}, 3, .9, true, .9};
  const double one = 1, x = .3;
  const auto conditional = [x](double y) { return 1 + .8 * std::cos(6 * y) * (2 * x - 1); };  // of x given y
  const double truth = 1 / (1 + .8 * std::sin(6.) / 6 * (2 * x - 1));
  for (int i = 0; i < 40000; ++i) {
    SampleStream stream(rng);
    std::vector<double> estimates(orders.draw(stream.uniformAboveZero()));
    for (double& e : estimates) e = conditional(stream.uniform());
    double value = 0;
    orders.sumAbout(1.1, estimates, std::span(&one, 1), std::span(&value, 1));
    values.add(value);
  }
  EXPECT_LT(std::abs(zTest(values, truth).z()), kMaxAbsZ) << zTest(values, truth, kSeed);
  EXPECT_GT(std::abs(zTest(values, 1.02 * truth).z()), kMaxAbsZ);
}

}  // namespace
}  // namespace pbrtmedia
