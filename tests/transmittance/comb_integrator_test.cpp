// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/comb_integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::ContractLine;
using test::FunctionLine;
using test::kMaxAbsZ;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241122;
constexpr Comb kCombs[] = {Comb::Equidistant, Comb::Stratified, Comb::Independent, Comb::GoldenRatio};

std::string wordFor(Comb comb) { return std::string(kChoices<Comb>[static_cast<std::size_t>(comb)]); }

/// One comb's estimate.
template <class Line>
double integralOf(const Line& line, const CombSettings& settings, std::uint64_t teeth, Rng& rng,
                  LookupTally& tally, bool checks = false) {
  const BoundProfile profile(line);
  SampleStream stream(rng);
  return CombIntegrator<Line>(line, profile, settings, teeth, checks, stream, tally).integral();
}
template <class Line>
double integralOf(const Line& line, const CombSettings& settings, std::uint64_t teeth, Rng& rng) {
  LookupTally tally;
  return integralOf(line, settings, teeth, rng, tally);
}

TEST(CombIntegrator, IsExactlyTheConstantTimesTheLength) {
  const FunctionLine line{[](double) { return .3; }, {{.7, {1, 0}}, {2, {.5f, 0}}}};
  Rng rng(kSeed);
  for (const Comb comb : kCombs) {
    for (const auto matching : {EndpointMatching::Off, EndpointMatching::On}) {
      for (const std::uint64_t teeth : {1u, 2u, 3u, 7u, 256u, 257u, 1000u, 100003u}) {
        // The same bits for every offset, so differences of combs vanish.
        EXPECT_EQ(integralOf(line, {comb, matching, Warp::Auto}, teeth, rng),
                  2 * static_cast<double>(.3f) * (static_cast<double>(teeth) / static_cast<double>(teeth)))
            << wordFor(comb) << ", " << teeth;
      }
    }
  }
}

TEST(CombIntegrator, MatchesEndsSoThatLinearDensitiesAreExactForEveryCombAndSize) {
  const FunctionLine line{[](double s) { return 5 - 2 * s; }, {{2, {5, 0}}}};
  Rng rng(kSeed);
  for (const Comb comb : kCombs) {
    for (const std::uint64_t teeth : {1u, 2u, 3u, 5u, 8u, 300u, 1000u}) {
      RunningStats matched, unmatched;
      for (int i = 0; i < 20; ++i) {
        matched.add(integralOf(line, {comb, EndpointMatching::On, Warp::Auto}, teeth, rng));
        unmatched.add(integralOf(line, {comb, EndpointMatching::Off, Warp::Auto}, teeth, rng));
        EXPECT_NEAR(integralOf(line, {comb, EndpointMatching::On, Warp::Auto}, teeth, rng), 6, 6 * 0x1p-23);
      }
      EXPECT_GT(unmatched.variance(), 1e3 * matched.variance()) << wordFor(comb) << ", " << teeth;
    }
  }
}

TEST(CombIntegrator, JoinsTwoCombsHalfAToothApartToTheOneOfTwiceTheTeeth) {
  const FunctionLine line{[](double s) { return 1 + s * s; }, {{1, {4, 0, 1.3f}}, {1.2, {4, 0, 2}}}};
  Rng rng(kSeed);
  SampleStream stream(rng);
  LookupTally tally;
  const BoundProfile profile(line);
  for (const auto matching : {EndpointMatching::Off, EndpointMatching::On}) {
    for (const Warp warp : {Warp::Off, Warp::On}) {
      for (const double u : {0., .3, .5, .9}) {
        CombIntegrator<FunctionLine> combs(line, profile, {Comb::Equidistant, matching, warp}, 3, false,
                                           stream, tally);
        EXPECT_EQ(combs.isWarped(), warp == Warp::On);
        const double halves = (combs.integralFrom(u) + combs.integralFrom(std::fmod(u + .5, 1))) / 2;
        combs.doubleTeeth();
        tally = {};
        EXPECT_NEAR(combs.integralFrom(std::fmod(2 * u, 1)), halves, 1e-6 * halves) << u;
        EXPECT_EQ(tally.lookups, 6u);  // ends are known
      }
    }
  }
}

/// In the warped variable it is rho / pdf that is linear.
TEST(CombIntegrator, MatchesEndsOfTheWarpedIntegrand) {
  // Means 1 and 3 over [0,1] and [1,3]: z = s / 7 below 1, (1 + 3 (s - 1)) / 7 above; h = rho 7 / mean.
  const auto zOf = [](double s) { return s < 1 ? s / 7 : (1 + 3 * (s - 1)) / 7; };
  const FunctionLine line{[&](double s) { return (2 + 4 * zOf(s)) * (s < 1 ? 1 : 3); },
                          {{1, {6, 0, 1}}, {3, {18, 0, 3}}}};
  Rng rng(kSeed);
  for (const Comb comb : kCombs) {
    for (const std::uint64_t teeth : {1u, 2u, 5u, 8u, 300u}) {
      const double exact = 7 * 4.0;
      EXPECT_NEAR(integralOf(line, {comb, EndpointMatching::On, Warp::On}, teeth, rng), exact,
                  exact * 0x1p-22)
          << wordFor(comb) << ", " << teeth;
    }
  }
}

/// A thin dense shell where the line begins, and a mean far below the density that stands at its end.
TEST(CombIntegrator, EndsThatSayNothingOfTheLineDoNoHarm) {
  const auto shell = [](double s) { return s < .01 ? 1000.0 : .2; };
  const FunctionLine straight{shell, {{.01, {1000, 0, 1000}}, {10, {.3f, 0, .2f}}}};
  const auto edge = [](double s) { return s < 9.99 ? 2.0 : 2 * std::pow(100 * (s - 9.99), 31); };
  const FunctionLine warped{edge, {{9.99, {2, 0, 2}}, {10, {2, 0, 2 / 32.f}}}};
  for (const auto& [line, warp, truth] :
       {std::tuple{straight, Warp::Off, 10 + 9.99 * .2}, {warped, Warp::On, 2 * 9.99 + .02 / 32}}) {
    const double upper = BoundProfile(line).upper();
    for (const Comb comb : kCombs) {
      Rng rng(kSeed);
      RunningStats matched, unmatched;
      double least = 0;
      for (int i = 0; i < 200000; ++i) {
        const double value = integralOf(line, {comb, EndpointMatching::On, warp}, 11, rng);
        matched.add(value);
        least = std::min(least, value);
        unmatched.add(integralOf(line, {comb, EndpointMatching::Off, warp}, 11, rng));
      }
      // Half a tooth of both ends for the equidistant comb, half of both for any.
      const double room = comb == Comb::Equidistant ? upper / 11 : upper;
      EXPECT_GE(least, -room) << wordFor(comb);
      EXPECT_LT(matched.variance(), 2 * unmatched.variance() + sqr(upper / 11)) << wordFor(comb);
      const auto test = test::zTest(matched, truth, kSeed);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << wordFor(comb) << ": " << test;
    }
  }
}

TEST(CombIntegrator, IsUnbiasedInEveryForm) {
  const double truth = ContractLine::integral();
  for (const Comb comb : kCombs) {
    for (const auto matching : {EndpointMatching::Off, EndpointMatching::On}) {
      for (const auto warp : {Warp::Off, Warp::On}) {
        for (const std::uint64_t teeth : {1u, 3u, 9u}) {
          Rng rng(kSeed);
          RunningStats values;
          for (int i = 0; i < 20000; ++i) {
            const ContractLine line;
            values.add(integralOf(line, {comb, matching, warp}, teeth, rng));
          }
          const auto test = test::zTest(values, truth, kSeed);
          EXPECT_LT(std::abs(test.z()), kMaxAbsZ)
              << wordFor(comb) << ", " << teeth << ", warp " << static_cast<int>(warp) << ": " << test;
        }
      }
    }
  }
}

TEST(CombIntegrator, HasLessVarianceTheMoreOrderlyItsTeethAre) {
  const FunctionLine line{[](double s) { return 1 + std::cos(20 * s + .8); }, {{1, {2, 0}}}};
  Rng rng(kSeed);
  const auto variance = [&](Comb comb) {
    RunningStats values;
    for (int i = 0; i < 4000; ++i)
      values.add(integralOf(line, {comb, EndpointMatching::Off, Warp::Auto}, 12, rng));
    return values.variance();
  };
  const double stratified = variance(Comb::Stratified);
  EXPECT_LT(variance(Comb::Equidistant) * 3, stratified);
  EXPECT_LT(stratified * 3, variance(Comb::Independent));
  EXPECT_LT(variance(Comb::GoldenRatio) * 3, variance(Comb::Independent));
}

TEST(CombIntegrator, WarpsOnlyWhereItIsSafe) {
  Rng rng(kSeed);
  SampleStream stream(rng);
  LookupTally tally;
  const auto warps = [&](const auto& line, Warp warp, std::uint64_t teeth) {
    const BoundProfile profile(line);
    using Line = std::decay_t<decltype(line)>;
    return CombIntegrator<Line>(line, profile, {.warp = warp}, teeth, false, stream, tally).isWarped();
  };
  const auto one = [](double) { return 1.0; };
  const FunctionLine known{one, {{1, {1, 0, 1}}, {2, {4, 0, 1}}}},
      unknown{one, {{1, {1, 0, 1}}, {2, {4, 0}}}};
  const FunctionLine emptyUnproven{one, {{1, {0, 0, 0}}, {2, {4, 0, 1}}}}, single{one, {{2, {4, 0, 1}}}};
  EXPECT_TRUE(warps(known, Warp::On, 100));
  EXPECT_TRUE(warps(known, Warp::Auto, 1));
  EXPECT_FALSE(warps(known, Warp::Auto, 2));
  EXPECT_FALSE(warps(known, Warp::Off, 2));
  EXPECT_FALSE(warps(unknown, Warp::On, 2));
  EXPECT_FALSE(warps(emptyUnproven, Warp::On, 2));
  EXPECT_FALSE(warps(single, Warp::On, 2));
  EXPECT_TRUE(warps(ContractLine(), Warp::On, 2));  // its empty stretch is proven
}

TEST(CombIntegrator, ReachesDensityUnderAMeanOfZero) {
  // A stored mean that was rounded, or guessed, to 0 where the bound is not.
  const FunctionLine line{[](double s) { return s < 1 ? .5 : 1.0; }, {{1, {.6f, 0, 0}}, {2, {1, 0, 1}}}};
  const auto test = test::runZTest(
      [&](Rng& rng) {
        return integralOf(line, {Comb::Equidistant, EndpointMatching::Off, Warp::On}, 4, rng);
      },
      1.5, kSeed, 400000);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(CombIntegrator, GainsFromTheWarpWhereDensityIsInFewSuperVoxels) {
  // Nearly all density in one of sixteen intervals.
  const auto density = [](double s) { return s >= 5 && s < 6 ? 3 + std::sin(6 * s) : .01; };
  FunctionLine line{density, {}};
  for (int i = 0; i < 16; ++i) {
    const double mean = test::simpson([&](double t) { return density(i + std::min(t, .9999999)); }, 0, 1);
    line.intervals.push_back({i + 1.0, {i == 5 ? 4.f : .01f, 0, static_cast<float>(mean)}});
  }
  Rng rng(kSeed);
  RunningStats straight, warped;
  for (int i = 0; i < 5000; ++i) {
    straight.add(integralOf(line, {Comb::Equidistant, EndpointMatching::Off, Warp::Off}, 8, rng));
    warped.add(integralOf(line, {Comb::Equidistant, EndpointMatching::Off, Warp::Auto}, 8, rng));
  }
  EXPECT_LT(warped.variance() * 100, straight.variance());
}

TEST(CombIntegrator, SpendsNoLookupInStretchesProvenEmpty) {
  Rng rng(kSeed);
  const ContractLine line;  // empty up to .3 of 2
  LookupTally tally;
  const double value =
      integralOf(line, {Comb::Equidistant, EndpointMatching::Off, Warp::Off}, 2000, rng, tally);
  EXPECT_EQ(tally.lookups, 1700u);
  EXPECT_EQ(line.asked(), 1700u);
  EXPECT_NEAR(value, ContractLine::integral(), 1e-3);
}

TEST(CombIntegrator, CountsTeethAndEnds) {
  const FunctionLine line{[](double s) { return s; }, {{1, {1, 0}}}};
  const BoundProfile profile(line);
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (const auto& [matching, teeth, ends] : {std::tuple{EndpointMatching::Auto, 7u, 0u},
                                              {EndpointMatching::Auto, 8u, 2u},
                                              {EndpointMatching::On, 1u, 2u},
                                              {EndpointMatching::Off, 100u, 0u}}) {
    LookupTally tally;
    CombIntegrator<FunctionLine> combs(line, profile, {.matching = matching}, teeth, true, stream, tally);
    EXPECT_EQ(tally.lookups, 0u);
    for (int i = 0; i < 5; ++i) combs.integral();
    EXPECT_EQ(tally.lookups, 5u * teeth + ends);
    EXPECT_EQ(tally.violations, 0u);
  }
}

TEST(CombIntegrator, NotesDensityAboveTheBoundOfItsOwnInterval) {
  const FunctionLine line{[](double s) { return s < 1 ? 1.0 : 4.0; },
                          {{.5, {1, 0}}, {1, {.5f, 0}}, {1.5, {5, 0}}, {2, {0, 0}}}};
  Rng rng(kSeed);
  for (const Comb comb : kCombs) {
    LookupTally tally;
    integralOf(line, {comb, EndpointMatching::Off, Warp::Auto}, 4000, rng, tally, true);
    EXPECT_NEAR(static_cast<double>(tally.violations), 2000, comb == Comb::Independent ? 160 : 3)
        << wordFor(comb);
    EXPECT_EQ(tally.worstRatio, std::numeric_limits<double>::infinity());
  }
}

TEST(CombIntegrator, AsksForTeethInOrderAndWithinTheLine) {
  Rng rng(kSeed);
  for (const Comb comb : kCombs) {
    std::vector<double> asked;
    const FunctionLine line{[&](double at) {
                              asked.push_back(at);
                              return 1.0;
                            },
                            {{3, {1, 0}}}};
    integralOf(line, {comb, EndpointMatching::Off, Warp::Auto}, 600, rng);
    ASSERT_EQ(asked.size(), 600u);
    std::vector<int> strata(600);
    for (const double s : asked) {
      ASSERT_TRUE(s >= 0 && s < 3) << s;
      ++strata[static_cast<std::size_t>(s * 200)];
    }
    const bool fillsStrata = comb == Comb::Equidistant || comb == Comb::Stratified;
    EXPECT_EQ(std::count(strata.begin(), strata.end(), 1) == 600, fillsStrata) << wordFor(comb);
  }
}

}  // namespace
}  // namespace pbrtmedia
