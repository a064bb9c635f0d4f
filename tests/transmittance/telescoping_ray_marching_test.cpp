// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/telescoping_ray_marching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "fields/canonical_line.h"
#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/unbiased_ray_marching.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20261130;
const std::vector<AnyLaw> kLaws{ExponentialLaw{}, PinkNoiseLaw{.8}, DavisLaw{.5, .5}, MixtureLaw{.3, .2, 2}};

struct Moments {
  double mean = 0, square = 0;
};

/// The depths that one offset of the base comb leads to: of its own comb at each level, and of that halfway
/// between its teeth.
struct Nested {
  std::vector<double> own, between;
};

/// Written from the definition, all teeth of every comb looked up: equidistant offsets.
std::vector<Nested> nestedCombs(const CanonicalLine& line, double sigma, int teeth, bool isMatched) {
  constexpr int kLevels = 8, kOffsets = 2000;
  const auto depthOf = [&](int n, double offset) {
    double sum = 0;
    for (int j = 0; j < n; ++j) sum += line.density((j + offset) / n * line.length());
    if (isMatched) sum += (.5 - offset) * (line.density(line.length()) - line.density(0));
    return sigma * sum * line.length() / n;
  };
  std::vector<Nested> all(kOffsets);
  for (int o = 0; o < kOffsets; ++o) {
    for (int level = 0; level < kLevels; ++level) {
      const double offset = std::fmod((o + .5) / kOffsets * (1 << level), 1.0);
      all[o].own.push_back(depthOf(teeth << level, offset));
      all[o].between.push_back(depthOf(teeth << level, std::fmod(offset + .5, 1.0)));
    }
  }
  return all;
}

/// First and second moment: the sum over what is corrected, the mean over the offset. Corrections beyond the
/// levels at hand are 0 by now.
Moments exactMoments(const std::vector<Nested>& combs, const AnyLaw& law, double q, double rate) {
  Moments moments;
  const double each = 1 / static_cast<double>(combs.size());
  for (const Nested& comb : combs) {
    const double base = transmittanceOf(law, comb.own[0]);
    const auto add = [&](double probability, double value) {
      moments.mean += each * probability * value;
      moments.square += each * probability * value * value;
    };
    double rest = 1;
    for (std::size_t level = 0; level < comb.own.size(); ++level) {
      const double own = comb.own[level], between = comb.between[level];
      const double fine = transmittanceOf(law, (own + between) / 2);
      const double coarse = (transmittanceOf(law, own) + transmittanceOf(law, between)) / 2;
      const double probability = q * rate * std::pow(1 - rate, level);
      add(probability, base + (fine - coarse) / probability);
      rest -= probability;
    }
    add(rest, base);
  }
  return moments;
}

TEST(TelescopingRayMarching, HasTheMeanAndTheVarianceOfItsDefinition) {
  for (const char* name : {"cosine", "linear-up", "hole", "step"}) {
    const auto function = *findCanonicalFunction(name);
    const CanonicalLine line(function, {.control = 1.5, .hasMeans = false});
    const double sigma = 2 / line.integral();
    for (const bool isMatched : {false, true}) {
      if (isMatched && std::string(name) == "linear-up") continue;  // no variance
      const std::vector<Nested> combs = nestedCombs(line, sigma, 3, isMatched);
      for (const AnyLaw& law : kLaws) {
        const TelescopingRayMarching estimator{
            .law = law,
            .tupleSize = 3,
            .endpointMatching = isMatched ? EndpointMatching::On : EndpointMatching::Off,
            .correctionProbability = .3,
            .rate = .8};
        const Moments exact = exactMoments(combs, law, .3, .8);
        const std::string what =
            std::string(name) + ", " + std::string(nameOf(law)) + (isMatched ? ", matched" : "");
        EXPECT_NEAR(exact.mean, transmittanceOf(law, 2), 2e-5) << what;
        RunningStats value, square;
        Rng rng(kSeed);
        for (int i = 0; i < 20000; ++i) {
          const double t = runEstimator(estimator, line, Channels<1>{sigma}, rng).value[0];
          value.add(t);
          square.add(t * t);
        }
        const auto mean = zTest(value, transmittanceOf(law, 2), kSeed);
        EXPECT_LT(std::abs(mean.z()), kMaxAbsZ) << what << ": " << mean;
        const auto second = zTest(square, exact.square, kSeed);
        EXPECT_LT(std::abs(second.z()), kMaxAbsZ) << what << ": " << second;
      }
    }
  }
}

TEST(TelescopingRayMarching, LooksAtTheTeethOfOneEquidistantCombWhateverTheLevel) {
  std::vector<double> places;
  const test::FunctionLine line{[&](double s) {
                                  places.push_back(s);
                                  return 1 + s;
                                },
                                {{1, {2, 0}}}};
  const TelescopingRayMarching estimator{.tupleSize = 3, .correctionProbability = 1, .rate = .55};
  Rng rng(kSeed);
  std::size_t most = 0;
  for (int i = 0; i < 100; ++i) {
    places.clear();
    const auto lookups = runEstimator(estimator, line, Channels<1>{1}, rng).tally.lookups;
    ASSERT_EQ(places.size(), lookups);
    std::sort(places.begin(), places.end());
    const double spacing = 1 / static_cast<double>(lookups);
    for (std::size_t j = 1; j < places.size(); ++j) {
      ASSERT_NEAR(places[j] - places[j - 1], spacing, 1e-12) << lookups << " teeth";
    }
    most = std::max(most, places.size());
  }
  EXPECT_GE(most, std::size_t{3} << 4);
}

/// Negative control: the comb without its corrections is rejected, and so are corrections of half the weight.
TEST(TelescopingRayMarching, WouldBeSeenWithoutCorrectionsOrWithHalfOfThem) {
  const auto function = *findCanonicalFunction("hole");
  const CanonicalLine line(function, {.hasMeans = false});
  const TelescopingRayMarching whole{.tupleSize = 2, .correctionProbability = .5};
  const TelescopingRayMarching base{.tupleSize = 2, .correctionProbability = .5, .maxLookups = 2};
  RunningStats none, half;
  Rng rng(kSeed);
  for (int i = 0; i < 30000; ++i) {
    const double t = runEstimator(base, line, Channels<1>{4}, rng).value[0];
    none.add(t);
    half.add((t + runEstimator(whole, line, Channels<1>{4}, rng).value[0]) / 2);
  }
  const double truth = std::exp(-4 * line.integral());
  EXPECT_GT(std::abs(zTest(none, truth).z()), kMaxAbsZ) << zTest(none, truth, kSeed);
  EXPECT_GT(std::abs(zTest(half, truth).z()), kMaxAbsZ) << zTest(half, truth, kSeed);
}

TEST(TelescopingRayMarching, SpendsOneCombAndRarelyTheTeethOfAGeometricLevel) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {.hasMeans = false});
  for (const bool isMatched : {false, true}) {
    const double q = .4, rate = .8;
    const std::uint64_t teeth = 5, ends = isMatched ? 2 : 0;
    const TelescopingRayMarching estimator{
        .tupleSize = teeth,
        .endpointMatching = isMatched ? EndpointMatching::On : EndpointMatching::Off,
        .correctionProbability = q,
        .rate = rate};
    constexpr double kRuns = 40000;
    std::map<std::uint64_t, double> counts;
    RunningStats cost;
    Rng rng(kSeed);
    for (int i = 0; i < kRuns; ++i) {
      const auto lookups = runEstimator(estimator, line, Channels<1>{1}, rng).tally.lookups;
      ++counts[lookups];
      cost.add(static_cast<double>(lookups));
    }
    const auto expectShare = [&](std::uint64_t lookups, double share) {
      EXPECT_LT(std::abs(counts[lookups] / kRuns - share), kMaxAbsZ * std::sqrt(share * (1 - share) / kRuns))
          << lookups;
      counts.erase(lookups);
    };
    expectShare(teeth + ends, 1 - q);
    for (int level = 0; level < 4; ++level) {
      expectShare((teeth << (level + 1)) + ends, q * rate * std::pow(1 - rate, level));
    }
    for (const auto& [lookups, count] : counts) EXPECT_GE(lookups, teeth << 5) << count;
    const double expected = static_cast<double>(teeth) * (1 + q / (2 * rate - 1)) + static_cast<double>(ends);
    const auto mean = zTest(cost, expected, kSeed);
    EXPECT_LT(std::abs(mean.z()), kMaxAbsZ) << mean;
  }
}

TEST(TelescopingRayMarching, IsExactInConstantMediaAndWithMatchedEndsInLinearOnes) {
  const auto constant = *findCanonicalFunction("constant"), linear = *findCanonicalFunction("linear-down");
  const CanonicalLine flat(constant, {.length = 2, .scale = .75, .control = 2}),
      ramp(linear, {.length = 2, .scale = .75});
  Rng rng(kSeed);
  for (const std::string_view name : lawNames()) {
    const AnyLaw law = *findLaw(name);
    for (const double sigma : {1e-300, 1e-8, .5, 4., 1e4, 1e300}) {
      const double truth = transmittanceOf(law, 1.5 * sigma);
      for (int i = 0; i < 50; ++i) {
        const TelescopingRayMarching often{.law = law, .tupleSize = 7, .correctionProbability = .9};
        EXPECT_NEAR(runEstimator(often, flat, Channels<1>{sigma}, rng).value[0], truth, 1e-12);
        const TelescopingRayMarching matched{.law = law,
                                             .tupleSize = 3,
                                             .endpointMatching = EndpointMatching::On,
                                             .correctionProbability = .9};
        EXPECT_NEAR(runEstimator(matched, ramp, Channels<1>{sigma}, rng).value[0], truth, 1e-12);
      }
    }
  }
}

TEST(TelescopingRayMarching, LooksNowhereWhereProvenBoundsLeaveNoExcess) {
  Rng rng(kSeed);
  const auto function = *findCanonicalFunction("constant");
  const CanonicalLine line(function, {.length = 2, .scale = .75, .lower = 1});
  const auto known = runEstimator(TelescopingRayMarching{}, line, Channels<3>{0, 1, 4}, rng);
  EXPECT_EQ(known.tally.lookups, 0u);
  EXPECT_EQ(known.value[0], 1);
  EXPECT_NEAR(known.value[1], std::exp(-1.5), 1e-15);
  EXPECT_NEAR(known.value[2], std::exp(-6), 1e-15);
  // Bounds that are not known to be true say nothing, even where they agree.
  const test::FunctionLine wrong{[](double s) { return s; }, {{1, {0, 0}}}};
  const auto looked = runEstimator(TelescopingRayMarching{}, wrong, Channels<1>{1}, rng);
  EXPECT_GE(looked.tally.lookups, 1u);
  EXPECT_GE(looked.tally.violations, 1u);
}

TEST(TelescopingRayMarching, ChoosesItsTeethAndCorrectionsByTheControl) {
  const TelescopingRayMarching parity{.tupleScale = 1};
  EXPECT_EQ(parity.teethFor(0), 1u);
  EXPECT_EQ(parity.teethFor(.05), 4u);
  EXPECT_EQ(parity.teethFor(.1), 8u);
  EXPECT_EQ(parity.teethFor(1), 8u);
  EXPECT_EQ(parity.teethFor(10), 18u);  // p-series CMF: 20
  EXPECT_EQ(parity.teethFor(1e15), TelescopingRayMarching::kMostTeeth);
  EXPECT_EQ(TelescopingRayMarching{}.teethFor(10), 27u);
  EXPECT_EQ((TelescopingRayMarching{.tupleSize = 5}.teethFor(10)), 5u);
  EXPECT_EQ((TelescopingRayMarching{.maxLookups = 12}.teethFor(10)), 12u);
  EXPECT_DOUBLE_EQ(parity.probabilityFor(10, 20, true), .1);
  EXPECT_EQ(parity.probabilityFor(0, 1, true), TelescopingRayMarching::kLeastProbability);
  EXPECT_EQ(parity.probabilityFor(0, 1, false), TelescopingRayMarching::kLeastProbabilityUnproven);
  EXPECT_EQ(parity.probabilityFor(1e9, 10, true), TelescopingRayMarching::kLargestProbability);
  EXPECT_EQ((TelescopingRayMarching{.correctionProbability = .7}.probabilityFor(0, 1, true)), .7);
}

TEST(TelescopingRayMarching, StaysBelowItsLimitAndCountsCorrectionsThatItLeavesOut) {
  const auto function = *findCanonicalFunction("gaussian");
  const CanonicalLine line(function, {.hasMeans = false});
  const auto shareCapped = [&](std::uint64_t most, EndpointMatching matching) {
    const TelescopingRayMarching estimator{.tupleSize = 4,
                                           .endpointMatching = matching,
                                           .correctionProbability = .5,
                                           .rate = .8,
                                           .maxLookups = most};
    EXPECT_EQ(estimator.traits().bias, EstimatorTraits::Bias::Consistent);
    EXPECT_TRUE(estimator.traits().boundedCost);
    RunningStats capped;
    Rng rng(kSeed);
    for (int i = 0; i < 10000; ++i) {
      const auto tally = runEstimator(estimator, line, Channels<1>{2}, rng).tally;
      EXPECT_LE(tally.lookups, most);
      capped.add(static_cast<double>(tally.capped));
    }
    return capped;
  };
  const auto expectShare = [&](const RunningStats& share, double expected) {
    const auto test = zTest(share, expected, kSeed);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  };
  expectShare(shareCapped(4, EndpointMatching::Off), .5);
  expectShare(shareCapped(8, EndpointMatching::Off), .5 * .2);
  expectShare(shareCapped(31, EndpointMatching::Off), .5 * .2 * .2);
  expectShare(shareCapped(8, EndpointMatching::On), .5);  // two look-ups at the ends
  expectShare(shareCapped(10, EndpointMatching::On), .5 * .2);
}

TEST(TelescopingRayMarching, TellsWhenItsVarianceIsFinite) {
  using T = TelescopingRayMarching;
  EXPECT_TRUE(T{}.traits().finiteVariance);
  EXPECT_FALSE((T{.rate = .95}.traits().finiteVariance));
  EXPECT_EQ(T{}.traits().control, EstimatorTraits::Control::CostOnly);
}

/// The geometric mean over controls, as a comb whose spacing meets a frequency of the density is lucky or
/// unlucky for either.
TEST(TelescopingRayMarching, HasLessVarianceTimesLookupsThanUnbiasedRayMarching) {
  for (const char* name : {"cosine", "gaussian", "step", "fractal-a"}) {
    const auto function = *findCanonicalFunction(name);
    constexpr double kControls[] = {1, 1.3, 1.7, 2.2, 3, 4, 5.5, 7.5};
    double logRatio = 0;
    for (const double control : kControls) {
      const CanonicalLine line(function, {.control = control, .hasMeans = false});
      const auto costliness = [&](const auto& estimator) {
        RunningStats value, lookups;
        Rng rng(kSeed);
        for (int i = 0; i < 2000; ++i) {
          const auto estimate = runEstimator(estimator, line, Channels<1>{1}, rng);
          value.add(estimate.value[0]);
          lookups.add(static_cast<double>(estimate.tally.lookups));
        }
        return value.variance() * lookups.mean();
      };
      logRatio += std::log(costliness(TelescopingRayMarching{}) / costliness(UnbiasedRayMarching{}));
    }
    EXPECT_LT(std::exp(logRatio / std::size(kControls)), .7) << name;
  }
}

}  // namespace
}  // namespace pbrtmedia
