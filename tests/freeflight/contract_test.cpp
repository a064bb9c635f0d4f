// SPDX-License-Identifier: BSD-2-Clause
// What every free-flight sampler of the list promises by its traits, checked over the list.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "freeflight/flight_list.h"
#include "support/contract_line.h"
#include "support/keyword_name.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::ContractLine;
using test::kMaxAbsZ;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241125;

template <std::size_t N>
FlightSample<N> run(const AnyFlight& sampler, const ContractLine& line, const Channels<N>& sigmaT,
                    SampleStream& stream, double albedo = .8, const AnyLaw* law = nullptr) {
  return visitFlight(
      [&](const auto& held) {
        return flyOn(held, line, FlightQuery<N>{sigmaT, filled<N>(albedo), filled<N>(1), law}, stream);
      },
      sampler);
}

/// Every model, as far as a parameter chooses one.
std::vector<AnyFlight> variantsOf(std::string_view name) {
  std::vector<AnyFlight> all{*findFlight(name)};
  for (const std::string model : {"terminating", "nonterminating"}) {
    AnyFlight other = *findFlight(name);
    if (setParameter(other, "model", ParameterValue(model)).known) all.push_back(other);
  }
  return all;
}

class SamplerContract : public testing::TestWithParam<std::string_view> {
 protected:
  AnyFlight sampler_ = *findFlight(GetParam());
  FlightTraits traits_ = traitsOf(sampler_);

  /// With parameters that differ much from those of the exponential law.
  std::vector<AnyLaw> lawsServed() const {
    std::vector<AnyLaw> laws{ExponentialLaw{}, PinkNoiseLaw{1.2}, DavisLaw{1.5, .4},     DavisLaw{.8, 0},
                             DavisLaw{.9, 1},  LinearLaw{2},      MixtureLaw{.3, .05, 4}};
    std::erase_if(laws, [&](const AnyLaw& law) { return !traits_.laws.has(law); });
    return laws;
  }
};

TEST_P(SamplerContract, SaysWhatItIs) {
  EXPECT_FALSE(traits_.summary.empty());
  EXPECT_FALSE(traits_.source.empty());
  EXPECT_FALSE(traits_.useWhen.empty());
  EXPECT_TRUE(traits_.bias == EstimatorTraits::Bias::Unbiased || !traits_.biasNote.empty());
}

TEST_P(SamplerContract, DescribesParametersThatCanBeSet) {
  std::set<std::string> names;
  for (const ParameterDescription& d : parametersOf(sampler_)) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name << " twice";
    const ParameterValue value =
        d.type == "string" ? ParameterValue(d.value) : ParameterValue(std::stod(d.value));
    const AssignResult set = setParameter(sampler_, d.name, value);
    EXPECT_TRUE(set.known && !set.error) << d.name;
    const AssignResult wrong = setParameter(sampler_, d.name, ParameterValue(true));
    EXPECT_TRUE(wrong.known && wrong.error) << d.name;
  }
  EXPECT_FALSE(setParameter(sampler_, "nosuchparameter", ParameterValue(1.0)).known);
}

TEST_P(SamplerContract, PassesWhatHoldsNothing) {
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (const auto kind : {ContractLine::Kind::Vacuum, ContractLine::Kind::Point}) {
    for (int n = 0; n < 20; ++n) {
      const auto flight = run<1>(sampler_, ContractLine(kind), {3}, stream);
      EXPECT_FALSE(flight.collided);
      EXPECT_EQ(flight.weight[0], 1.0);
    }
  }
  const auto clear = run<3>(sampler_, ContractLine(), {0, 0, 0}, stream);
  EXPECT_FALSE(clear.collided);
  for (const double w : clear.weight) EXPECT_EQ(w, 1.0);
}

TEST_P(SamplerContract, CountsEveryLookup) {
  const ContractLine line(1.5);
  Rng rng(kSeed);
  SampleStream stream(rng);
  std::uint64_t lookups = 0;
  for (int n = 0; n < 500; ++n) {
    lookups += run<1>(sampler_, line, {2}, stream).tally.lookups;
    lookups += run<3>(sampler_, line, {.5, 1, 2}, stream).tally.lookups;
  }
  EXPECT_EQ(lookups, line.asked());
}

/// Weighted collisions per bin and transmitted weight, against exp(-sigma F) or another law of sigma F.
void expectFlights(const AnyFlight& sampler, const ContractLine& line, const Channels<3>& sigma,
                   double rounding, const AnyLaw& law = {}) {
  constexpr int kBins = 12, kN = 25000;
  Rng rng(kSeed);
  SampleStream stream(rng);
  RunningStats passed[3], collided[3][kBins], alone[kBins], alonePassed;
  for (int n = 0; n < kN; ++n) {
    const auto flight = run<3>(sampler, line, sigma, stream, .8, &law);
    const auto single = run<1>(sampler, line, {sigma[2]}, stream, .8, &law);
    const auto bin = [](double s) { return std::min(kBins - 1, static_cast<int>(s / 2 * kBins)); };
    for (int b = 0; b < kBins; ++b) {
      for (std::size_t c = 0; c < 3; ++c) {
        collided[c][b].add(flight.collided && bin(flight.s) == b ? flight.weight[c] : 0);
      }
      alone[b].add(single.collided && bin(single.s) == b ? single.weight[0] : 0);
    }
    for (std::size_t c = 0; c < 3; ++c) passed[c].add(flight.collided ? 0 : flight.weight[c]);
    alonePassed.add(single.collided ? 0 : single.weight[0]);
  }
  const auto expectMean = [&](const RunningStats& values, double truth, const std::string& what) {
    EXPECT_LE(std::abs(values.mean() - truth), kMaxAbsZ * values.standardError() + rounding)
        << nameOf(sampler) << ' ' << what << ": " << test::zTest(values, truth, kSeed);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const auto through = [&](double s) {
      return transmittanceOf(law, sigma[c] * ContractLine::integralTo(s));
    };
    const std::string channel = "channel " + std::to_string(c);
    expectMean(passed[c], through(2), channel + " passed");
    for (int b = 0; b < kBins; ++b) {
      const double share = through(2. * b / kBins) - through(2. * (b + 1) / kBins);
      expectMean(collided[c][b], share, channel + " bin " + std::to_string(b));
      if (c == 2) expectMean(alone[b], share, "alone, bin " + std::to_string(b));
    }
    if (c == 2) expectMean(alonePassed, through(2), "alone passed");
  }
}

TEST_P(SamplerContract, FliesAsTheDensitySays) {
  for (const AnyFlight& sampler : variantsOf(GetParam())) {
    for (const double looseness : {1., 2.5}) {
      // The midpoint rule with 64 steps misses the edges of pieces by a fraction of a step.
      const double rounding = traits_.bias == EstimatorTraits::Bias::Unbiased ? 1e-6 : 4e-3;
      expectFlights(sampler, ContractLine(looseness, looseness > 2), {0, 1, 3}, rounding);
    }
  }
}

TEST_P(SamplerContract, FliesUnderEveryLawThatItServes) {
  EXPECT_TRUE(traits_.laws == LawSet::mixtures() || traits_.laws == LawSet::all());
  for (const AnyLaw& law : lawsServed()) {
    const double rounding = traits_.bias == EstimatorTraits::Bias::Unbiased ? 1e-6 : 4e-3;
    expectFlights(sampler_, ContractLine(1.6), {0, 1, 3}, rounding, law);
  }
}

TEST_P(SamplerContract, GivesEveryImportanceTheSameMeans) {
  for (const Channels<3>& throughput : {Channels<3>{1, 1, 1}, {0, .1, -5}, {2, 0, 1}, {0, 0, 3}}) {
    const FlightQuery<3> query{{.2, 1, 3}, filled<3>(.8), importanceOf(throughput)};
    Rng rng(kSeed);
    SampleStream stream(rng);
    RunningStats passed[3];
    double largest = 0;
    for (int n = 0; n < 40000; ++n) {
      const auto flight =
          visitFlight([&](const auto& held) { return flyOn(held, ContractLine(), query, stream); }, sampler_);
      double mean = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        passed[c].add(flight.collided ? 0 : flight.weight[c]);
        mean += flight.weight[c] * query.importance[c] / 3;
      }
      largest = std::max(largest, mean);
    }
    // Weighed as the path weighs them, the channels' weights are 1 on the mean.
    if (traits_.unitWeights) {
      EXPECT_NEAR(largest, 1, 1e-9);
    }
    const double rounding = traits_.bias == EstimatorTraits::Bias::Unbiased ? 1e-6 : 4e-3;
    for (std::size_t c = 0; c < 3; ++c) {
      const double truth = throughput[c] != 0 ? std::exp(-query.sigmaT[c] * ContractLine::integralTo(2)) : 0;
      EXPECT_LE(std::abs(passed[c].mean() - truth), kMaxAbsZ * passed[c].standardError() + rounding)
          << "channel " << c << ": " << test::zTest(passed[c], truth, kSeed);
    }
  }
}

TEST(FlightContract, TheTestSeesAnotherLaw) {
  const AnyLaw flown = LinearLaw{4}, claimed = LinearLaw{3};
  Rng rng(kSeed);
  SampleStream stream(rng);
  RunningStats passed;
  for (int n = 0; n < 25000; ++n) {
    passed.add(run<1>(RegularFlight{}, ContractLine(), {2}, stream, .8, &flown).collided ? 0 : 1);
  }
  const double depth = 2 * ContractLine::integralTo(2);
  EXPECT_LT(std::abs(test::zTest(passed, transmittanceOf(flown, depth), kSeed).z()), kMaxAbsZ);
  EXPECT_GT(std::abs(test::zTest(passed, transmittanceOf(claimed, depth), kSeed).z()), kMaxAbsZ);
}

TEST_P(SamplerContract, StaysRightUnderALowControlIfItSaysSo) {
  if (traits_.bias != EstimatorTraits::Bias::Unbiased ||
      traits_.control == EstimatorTraits::Control::Bounding) {
    GTEST_SKIP() << "makes no such claim";
  }
  for (const AnyFlight& sampler : variantsOf(GetParam())) {
    expectFlights(sampler, ContractLine(.7, false, .5), {.2, .6, 1.5}, 1e-6);
  }
  // Any law will do.
  expectFlights(sampler_, ContractLine(.7, false, .5), {.2, .6, 1.5}, 1e-6, DavisLaw{1.5, .4});
}

TEST_P(SamplerContract, KeepsWeightOneIfItSaysSo) {
  if (!traits_.unitWeights) GTEST_SKIP() << "makes no such claim";
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (int n = 0; n < 20000; ++n) {
    const auto flight = run<1>(sampler_, ContractLine(n % 2 ? 1 : 3, n % 3 == 0), {2}, stream);
    ASSERT_NEAR(flight.weight[0], 1.0, 1e-12);
    if (flight.collided) {
      ASSERT_GE(flight.s, 0.0);
      ASSERT_LE(flight.s, 2.0);
    }
  }
}

TEST_P(SamplerContract, StaysFiniteFromThinnestToThickest) {
  for (const double sigma : {1e-300, 1e-30, 1e-8, 1e-3, 1., 30., 1e3, 1e6}) {
    Rng rng(kSeed);
    SampleStream stream(rng);
    for (int n = 0; n < 5; ++n) {
      const auto one = run<1>(sampler_, ContractLine(), {sigma}, stream);
      const auto three = run<3>(sampler_, ContractLine(), {0, sigma / 100, sigma}, stream);
      EXPECT_TRUE(std::isfinite(one.weight[0])) << sigma;
      for (const double w : three.weight) EXPECT_TRUE(std::isfinite(w)) << sigma;
    }
  }
}

TEST_P(SamplerContract, TakesTheSameStepsOnAShorterLine) {
  if (traits_.bias != EstimatorTraits::Bias::Unbiased) GTEST_SKIP() << "its steps are shares of the line";
  // Overlapping media rely on it: up to the cut the flight is the same, and one that ended beyond it passes.
  for (const double cut : {.5, 1.2, 1.7}) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
      Rng wholeRng(seed), partRng(seed);
      SampleStream whole(wholeRng), part(partRng);
      ContractLine shorter(1.5);
      shorter.cutAt(cut);
      const auto a = run<1>(sampler_, ContractLine(1.5), {2}, whole),
                 b = run<1>(sampler_, shorter, {2}, part);
      ASSERT_EQ(b.collided, a.collided && a.s < cut) << seed;
      if (b.collided) {
        ASSERT_NEAR(b.s, a.s, 1e-6) << seed;
      }
    }
  }
  for (const AnyLaw& law : lawsServed()) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      Rng wholeRng(seed), partRng(seed);
      SampleStream whole(wholeRng), part(partRng);
      ContractLine shorter(1.5);
      shorter.cutAt(1.2);
      const auto a = run<1>(sampler_, ContractLine(1.5), {2}, whole, .8, &law),
                 b = run<1>(sampler_, shorter, {2}, part, .8, &law);
      ASSERT_EQ(b.collided, a.collided && a.s < 1.2) << nameOf(law) << ' ' << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SamplerContract, testing::ValuesIn(flightNames()), test::keywordName);

TEST_P(SamplerContract, FliesByThePointsOfAPattern) {
  // Stratified first dimensions: no bias, and never more variance than independent flights beyond chance.
  constexpr std::uint32_t kPoints = 16, kPixels = 4000;
  const ContractLine line(1.5);
  Rng rng(kSeed);
  RunningStats stratified, independent;
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    const SamplingPattern pattern(PatternKind::LatinHypercube, kPoints, kSeed + pixel);
    double byPattern = 0, byRng = 0;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      SampleStream point(rng, pattern, i), free(rng);
      const auto a = run<1>(sampler_, line, {1}, point), b = run<1>(sampler_, line, {1}, free);
      byPattern += a.collided ? 0 : a.weight[0] / kPoints;
      byRng += b.collided ? 0 : b.weight[0] / kPoints;
    }
    stratified.add(byPattern);
    independent.add(byRng);
  }
  const double truth = std::exp(-ContractLine::integral());
  const double rounding = traits_.bias == EstimatorTraits::Bias::Unbiased ? 1e-6 : 4e-3;
  EXPECT_LE(std::abs(stratified.mean() - truth), kMaxAbsZ * stratified.standardError() + rounding)
      << test::zTest(stratified, truth, kSeed);
  // 4000 pixels: variances are known to 2.2 %.
  EXPECT_LT(stratified.variance(), 1.12 * independent.variance());
  // One dimension decides whether such flights pass: at most one of 16 strata is undecided.
  if (traits_.control == EstimatorTraits::Control::Unused) {
    EXPECT_LT(stratified.variance(), .1 * independent.variance());
  }
}

/// The contract can fail: another optical depth is noticed.
TEST(SamplerContractItself, NoticesAnExtinctionThatIsThreePercentOff) {
  Rng rng(kSeed);
  SampleStream stream(rng);
  RunningStats passed;
  for (int n = 0; n < 100000; ++n) {
    passed.add(run<1>(WeightedDeltaTracking{}, ContractLine(), {.97}, stream).collided ? 0 : 1);
  }
  EXPECT_GT(std::abs(passed.mean() - std::exp(-ContractLine::integral())), kMaxAbsZ * passed.standardError());
}

}  // namespace
}  // namespace pbrtmedia
