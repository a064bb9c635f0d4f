// SPDX-License-Identifier: BSD-2-Clause
// The parts of medialab that need no process.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/rng.h"
#include "support/statistics.h"
#include "support/temporary_folder.h"
#include "tools/medialab/canvas.h"
#include "tools/medialab/fit.h"
#include "tools/medialab/heatmap_picture.h"
#include "tools/medialab/isolated.h"
#include "tools/medialab/moments.h"
#include "tools/medialab/reciprocal_verdict.h"
#include "tools/medialab/session.h"
#include "tools/medialab/stress_cases.h"
#include "tools/medialab/verdict.h"

namespace pbrtmedia {
namespace {

TEST(Moments, AreThoseOfTheDefinition) {
  // 1, 2, 3, 4, 10: mean 4, squares 9 4 1 0 36, fourth powers 81 16 1 0 1296.
  Moments all, left, right;
  for (const double x : {1, 2, 3, 4, 10}) all.add(x);
  for (const double x : {1, 2}) left.add(x);
  for (const double x : {3, 4, 10}) right.add(x);
  left.add(right);
  for (const Moments& m : {all, left}) {
    EXPECT_EQ(m.count(), 5u);
    EXPECT_NEAR(m.mean(), 4, 1e-14);
    EXPECT_NEAR(m.variance(), 12.5, 1e-13);
    EXPECT_NEAR(m.meanError(), std::sqrt(2.5), 1e-14);
    EXPECT_NEAR(m.varianceError(), std::sqrt((1394.0 / 5 - 12.5 * 12.5 * 2 / 4) / 5), 1e-12);
  }
}

TEST(Moments, TellWhenThereIsNothingToSay) {
  Moments none;
  EXPECT_TRUE(std::isnan(none.mean()));
  EXPECT_TRUE(std::isnan(none.variance()));
  none.add(Moments{});
  none.add(3);
  EXPECT_EQ(none.mean(), 3);
  EXPECT_TRUE(std::isnan(none.meanError()));
}

TEST(Moments, EqualValuesHaveNoVariance) {
  Moments m;
  for (int i = 0; i < 1000; ++i) m.add(0.1);
  EXPECT_EQ(m.variance(), 0);
}

TEST(LogSlope, IsExactOnAPowerAndHasTheErrorOfItsPoints) {
  std::vector<LogPoint> points;
  for (double x = 1; x < 2000; x *= 2) points.push_back({x, 3 / std::sqrt(x), 0.03 / std::sqrt(x)});
  const LogSlope fit = fitLogSlope(points);
  EXPECT_NEAR(fit.slope, -0.5, 1e-12);
  // Equal relative errors r: the error of the slope is r / sqrt(sum of squared distances in log x).
  double squares = 0;
  for (int i = -5; i <= 5; ++i) squares += i * i * std::log(2.0) * std::log(2.0);
  EXPECT_NEAR(fit.error, 0.01 / std::sqrt(squares), 1e-12);
  EXPECT_TRUE(std::isnan(fitLogSlope({}).slope));
  EXPECT_TRUE(std::isnan(fitLogSlope(std::span(points).first(1)).slope));
}

TEST(LabTable, CsvQuotesAndJsonKeepsTypes) {
  LabTable table("medialab test", {"name", "value", "count", "yes"});
  table.add({std::string("a,\"b\""), 0.1, std::uint64_t{7}, true});
  table.add({std::string("c"), std::nan(""), std::uint64_t{0}, false});
  table.note("a note");
  table.skip("x", "because");
  std::ostringstream csv, json;
  table.write(csv, TableFormat::Csv);
  EXPECT_EQ(csv.str(),
            "# medialab test\n# a note\n# skipped: x: because\nname,value,count,yes\n"
            "\"a,\"\"b\"\"\",0.1,7,true\nc,nan,0,false\n");
  table.markStopped();
  table.write(json, TableFormat::Json, {{"seed", std::uint64_t{5}}, {"program", std::string("p")}});
  const auto document = nlohmann::json::parse(json.str());
  EXPECT_EQ(document["command"], "medialab test");
  EXPECT_EQ(document["provenance"], (nlohmann::json{{"seed", 5}, {"program", "p"}}));
  EXPECT_EQ(document["rows"][0]["value"], 0.1);
  EXPECT_TRUE(document["rows"][1]["value"].is_null());
  EXPECT_EQ(document["skipped"][0]["reason"], "because");
  EXPECT_EQ(document["stopped"], true);
  EXPECT_THROW(table.add({0.1}), std::logic_error);
  EXPECT_THROW(table.column("none"), std::logic_error);
}

TEST(LabTable, TextIsAlignedAndRounded) {
  LabTable table("medialab test", {"name", "value", "n"});
  table.add({std::string("a longer one"), 0.123456789, std::uint64_t{7}});
  table.add({std::string("c"), std::nan(""), std::uint64_t{12345}});
  table.note("a note");
  table.skip("x", "because");
  table.markStopped();
  std::ostringstream text;
  table.write(text, TableFormat::Text);
  EXPECT_EQ(text.str(),
            "name            value      n\n"
            "a longer one  0.12346      7\n"
            "c                 nan  12345\n"
            "a note\nskipped: x: because\nstopped before the end: rows are missing\n");
}

TEST(IdentityText, IsWhatIsMeasuredWhateverBecomesOfIt) {
  const auto identity = [](std::vector<const char*> words) {
    words.insert(words.begin(), "medialab");
    return identityText(static_cast<int>(words.size()), words.data());
  };
  const TemporaryFolder folder;
  const std::string table = (folder.path() / "t.csv").string();
  std::ofstream(table) << "0,1\n1,2\n";
  const std::string extinction = "cosine," + table;
  const std::string before = identity({"estimate", "--extinction", extinction.c_str(), "--trials", "9"});
  EXPECT_EQ(before.find("medialab estimate --extinction cosine,"), 0u) << before;
  EXPECT_NE(before.find("pbrt-media "), before.npos) << before;
  EXPECT_EQ(before, identity({"estimate", "--extinction", extinction.c_str(), "--trials", "9", "-o", "a.json",
                              "--format=json", "--resume", "j", "--quiet", "--nthreads=4", "--no-seconds"}));
  EXPECT_NE(before, identity({"estimate", "--extinction", extinction.c_str(), "--trials", "8"}));
  const std::string joined = "--extinction=" + extinction, ofJoined = identity({"estimate", joined.c_str()});
  std::ofstream(table) << "0,1\n1,3\n";
  EXPECT_NE(before, identity({"estimate", "--extinction", extinction.c_str(), "--trials", "9"}));
  EXPECT_NE(ofJoined, identity({"estimate", joined.c_str()}));
}

TEST(CommandText, NamesNoFolderAndNothingThatCannotMatter) {
  const char* words[] = {
      "/some/where/medialab", "estimate", "--outfile", "/tmp/a b.csv",      "--threads", "3", "--quiet",
      "--param=a=b c",        "-o",       "/x/y.csv",  "--picture=/p/q.png"};
  EXPECT_EQ(commandText(11, words),
            "medialab estimate --outfile 'a b.csv' '--param=a=b c' -o y.csv --picture=q.png");
}

TEST(ChernoffBound, IsTheExactExponentForCertainEvents) {
  // All of n values 0 under expectation p has probability (1 - p)^n; the bound doubles it.
  EXPECT_NEAR(logChernoffBound(0, 0.1, 50), std::log(2 * std::pow(0.9, 50)), 1e-12);
  EXPECT_NEAR(logChernoffBound(0.1, 0.1, 50), std::log(2.0), 1e-12);
  EXPECT_LT(logChernoffBound(0.5, 0.1, 50), std::log(1e-8));
}

IsolatedResult resultOf(const std::vector<double>& values, double expected) {
  IsolatedResult result;
  result.end = IsolatedResult::End::Done;
  for (const double x : values) {
    result.stats.value.add(x);
    result.stats.least = std::min(result.stats.least, x);
    result.stats.most = std::max(result.stats.most, x);
    result.stats.largestDeviation = std::max(result.stats.largestDeviation, std::abs(x - expected));
  }
  return result;
}

TEST(StressVerdict, FollowsWhatTheTraitsPromise) {
  using Kind = StressVerdict::Kind;
  EstimatorTraits t;
  t.control = EstimatorTraits::Control::Bounding;
  const StressSetting setting{.exact = 0.5, .depth = std::log(2.0), .controlDepth = 1};
  std::vector<double> fair, biased;
  for (int i = 0; i < 1000; ++i) {
    fair.push_back(i % 2);
    biased.push_back(i % 4 == 0);
  }
  EXPECT_EQ(judge(t, setting, resultOf(fair, 0.5)).kind, Kind::Pass);
  EXPECT_EQ(judge(t, setting, resultOf(biased, 0.5)).kind, Kind::Fail);
  // Below a bound nothing is claimed.
  StressSetting low = setting;
  low.isBounding = false;
  EXPECT_EQ(judge(t, low, resultOf(biased, 0.5)).kind, Kind::Expected);
  // A rare event that did not come.
  StressSetting rare = setting;
  rare.exact = 1e-9;
  EXPECT_EQ(judge(t, rare, resultOf(std::vector<double>(1000, 0.0), 1e-9)).kind, Kind::Undecided);
  // The same zeros refute a transmittance that would have shown.
  EXPECT_EQ(judge(t, setting, resultOf(std::vector<double>(1000, 0.0), 0.5)).kind, Kind::Fail);
  // Outside of [0, 1].
  EXPECT_EQ(judge(t, setting, resultOf({-1, 2, -1, 2}, 0.5)).kind, Kind::Fail);
  t.mayLeaveUnitInterval = true;
  std::vector<double> wide;
  for (int i = 0; i < 1000; ++i) wide.push_back(i % 2 == 0 ? -1 : 2);
  EXPECT_EQ(judge(t, setting, resultOf(wide, 0.5)).kind, Kind::Pass);
  EXPECT_EQ(judge(t, setting, resultOf({-1, 2, -1, 2}, 0.5)).kind, Kind::Undecided);
  // Values that are not finite.
  IsolatedResult broken = resultOf(fair, 0.5);
  broken.stats.nonFinite = 1;
  EXPECT_EQ(judge(t, setting, broken).kind, Kind::Fail);
  IsolatedResult crashed;
  crashed.end = IsolatedResult::End::Crashed;
  EXPECT_EQ(judge(t, setting, crashed).kind, Kind::Fail);
  IsolatedResult hung;
  hung.end = IsolatedResult::End::OutOfTime;
  EXPECT_EQ(judge(t, setting, hung).kind, Kind::Fail);
  t.bias = EstimatorTraits::Bias::Biased;
  EXPECT_EQ(judge(t, setting, resultOf(biased, 0.5)).kind, Kind::Pass);
}

TEST(RunIsolated, SurvivesCrashesHangsAndExceptions) {
  using End = IsolatedResult::End;
  const std::vector<std::function<TrialStats()>> jobs{[] {
                                                        TrialStats stats;
                                                        stats.value.add(0.25);
                                                        return stats;
                                                      },
                                                      []() -> TrialStats {
                                                        std::signal(SIGABRT, SIG_DFL);
                                                        std::raise(SIGABRT);
                                                        return {};
                                                      },
                                                      []() -> TrialStats {
                                                        std::atomic<int> turns{0};
                                                        for (;;) ++turns;
                                                      },
                                                      []() -> TrialStats { throw std::runtime_error("no"); }};
  const std::atomic<bool> stop{false};
  std::size_t done = 0;
  const auto results = runIsolated(jobs, 2, 0.3, stop, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 4u);
  EXPECT_EQ(results[0].end, End::Done);
  EXPECT_EQ(results[0].stats.value.mean(), 0.25);
  EXPECT_EQ(results[1].end, End::Crashed);
  EXPECT_EQ(results[2].end, End::OutOfTime);
  EXPECT_EQ(results[3].end, End::Threw);
  EXPECT_EQ(results[3].message, "no");
  const std::atomic<bool> stopped{true};
  EXPECT_EQ(runIsolated(jobs, 2, 0.3, stopped, [](std::size_t) {})[0].end, End::NotRun);
}

TEST(StressCases, HaveNamesOfTheirOwnAndTheDepthTheySay) {
  std::set<std::string> names;
  for (const StressCase& one : stressCases()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    const CanonicalLine line(one.function, one.setup);
    EXPECT_EQ(line.length(), one.setup.length);
    EXPECT_TRUE(std::isfinite(line.integral()));
    // The least number a float holds below these densities is far below them, so the depth is met.
    if (line.integral() > 0) {
      double sum = 0;
      for (int i = 0; i < 1000; ++i) {
        sum += static_cast<double>(line.density((i + 0.5) / 1000 * line.length())) * line.length() / 1000;
      }
      if (one.name.find("spike") == std::string::npos && one.name.find("offset") == std::string::npos) {
        EXPECT_NEAR(sum / line.integral(), 1, 0.01) << one.name;
      }
    }
  }
  EXPECT_GT(names.size(), 40u);
}

TEST(StressCases, OfReciprocalsHaveNamesOfTheirOwnAndTheDepthTheySay) {
  std::set<std::string> names;
  for (const StressCase& one : reciprocalStressCases()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    const CanonicalLine line(one.function, one.setup);
    const double integral = line.integral(),
                 sigmaT = integral > 0 ? one.depth / integral : one.sigmaOfNothing;
    const ReciprocalSetting setting = reciprocalSettingOf(line, sigmaT);
    if (one.depth > 0 && integral > 0) {
      EXPECT_NEAR(setting.exact * one.depth, 1, 1e-12) << one.name;
    } else {
      EXPECT_TRUE(std::isinf(setting.exact)) << one.name;
    }
  }
  EXPECT_GT(names.size(), 30u);
}

TEST(ReciprocalSetting, HasTheMomentsOfItsRatio) {
  // A constant under k times itself: r = 1 - 1 / k everywhere.
  const CanonicalFunction constant = *findCanonicalFunction("constant");
  for (const double k : {.4, 1., 5.}) {
    const ReciprocalSetting s = reciprocalSettingOf(CanonicalLine(constant, {.control = k}), 3);
    EXPECT_NEAR(s.exact, 1. / 3, 1e-15);
    EXPECT_NEAR(s.controlOverF, k, 1e-12);
    EXPECT_EQ(s.isBounding, k >= 1);
    EXPECT_NEAR(s.absolute, std::abs(1 - 1 / k), 1e-12);
    EXPECT_NEAR(s.square, (1 - 1 / k) * (1 - 1 / k), 1e-12);
  }
  // 2x under 2k: r = 1 - x / k with E|r| = 1 - 1/(2k) and E[r^2] = 1 - 1/k + 1/(3k^2) for k >= 1.
  const CanonicalFunction ramp = *findCanonicalFunction("linear-up");
  for (const double k : {1., 2.}) {
    const ReciprocalSetting s = reciprocalSettingOf(CanonicalLine(ramp, {.control = k}), 1);
    EXPECT_NEAR(s.absolute, 1 - 1 / (2 * k), 1e-6);
    EXPECT_NEAR(s.square, 1 - 1 / k + 1 / (3 * k * k), 1e-5);
    EXPECT_FALSE(s.isPositive);
  }
  // A step at the border of the second of four super-voxels, whose bound is that of both sides: alpha = (1 +
  // 3 + 3 + 3) / 4, and r = 2 / 3 in the second.
  const CanonicalFunction halves{{"halves", "", ""}, {{.end = .5, .constant = 1}, {.end = 1, .constant = 3}}};
  const ReciprocalSetting s = reciprocalSettingOf(CanonicalLine(halves, {.superVoxels = 4}), 1);
  EXPECT_NEAR(s.controlOverF, 1.25, 1e-9);
  EXPECT_NEAR(s.absolute, .2, 1e-9);
  EXPECT_NEAR(s.square, .3 * 4 / 9, 1e-9);
  EXPECT_TRUE(s.isPositive);
}

TEST(ReciprocalVerdict, FollowsWhatTheTraitsPromise) {
  using Kind = StressVerdict::Kind;
  ReciprocalTraits t;
  t.seriesLimit = 1;
  const ReciprocalSetting setting{.exact = 2, .controlOverF = 3, .absolute = .5, .square = .3};
  std::vector<double> fair, biased;
  for (int i = 0; i < 1000; ++i) {
    fair.push_back(i % 2 == 0 ? 1 : 3);
    biased.push_back(i % 2 == 0 ? 1 : 2);
  }
  EXPECT_EQ(judgeReciprocal(t, setting, resultOf(fair, 2)).kind, Kind::Pass);
  EXPECT_EQ(judgeReciprocal(t, setting, resultOf(biased, 2)).kind, Kind::Fail);
  // One trial that makes the variance says nothing.
  std::vector<double> heavy(1000, 1.0);
  heavy[0] = 5;
  EXPECT_EQ(judgeReciprocal(t, setting, resultOf(heavy, 2)).kind, Kind::Undecided);
  // An event of probability 1e-6 that did not come, and one of 0.1 that should have.
  ReciprocalSetting rare = setting;
  rare.exact = 1 + 1e-6;
  EXPECT_EQ(judgeReciprocal(t, rare, resultOf(std::vector<double>(1000, 1.0), 1)).kind, Kind::Undecided);
  rare.exact = 1.1;
  EXPECT_EQ(judgeReciprocal(t, rare, resultOf(std::vector<double>(1000, 1.0), 1)).kind, Kind::Fail);
  // Under a control that is too low the series decides, or the traits say that it must bound.
  ReciprocalSetting low = setting;
  low.isBounding = false;
  EXPECT_EQ(judgeReciprocal(t, low, resultOf(biased, 2)).kind, Kind::Fail);
  low.square = 1.5;
  EXPECT_NE(judgeReciprocal(t, low, resultOf(biased, 2)).reason.find("variance"), std::string::npos);
  low.absolute = 1;
  EXPECT_NE(judgeReciprocal(t, low, resultOf(biased, 2)).reason.find("out of its domain"), std::string::npos);
  ReciprocalTraits bounding = t;
  bounding.control = EstimatorTraits::Control::Bounding;
  EXPECT_EQ(judgeReciprocal(bounding, low, resultOf(fair, 2)).reason, "needs a bounding control");
  // Densities that are 0 somewhere.
  ReciprocalTraits march = t;
  march.control = EstimatorTraits::Control::Unused;
  march.needsPositiveDensity = true;
  IsolatedResult broken = resultOf(fair, 2);
  broken.stats.nonFinite = 1;
  EXPECT_EQ(judgeReciprocal(march, setting, broken).kind, Kind::Fail);
  ReciprocalSetting zero = setting;
  zero.isPositive = false;
  EXPECT_EQ(judgeReciprocal(march, zero, broken).kind, Kind::Expected);
  // F = 0.
  ReciprocalSetting nothing = setting;
  nothing.exact = std::numeric_limits<double>::infinity();
  IsolatedResult infinite = resultOf({}, 0);
  infinite.stats.nonFinite = 100;
  EXPECT_EQ(judgeReciprocal(t, nothing, infinite).kind, Kind::Pass);
  EXPECT_EQ(judgeReciprocal(t, nothing, resultOf(fair, 2)).kind, Kind::Fail);
  nothing.isEmptyUnderControl = true;
  EXPECT_EQ(judgeReciprocal(t, nothing, resultOf(fair, 2)).kind, Kind::Expected);
  // A control of 0 over density has to be noticed.
  ReciprocalSetting blind = setting;
  blind.isBlind = true;
  EXPECT_EQ(judgeReciprocal(t, blind, resultOf(fair, 2)).kind, Kind::Fail);
  IsolatedResult noticed = resultOf(biased, 2);
  noticed.stats.violations = 7;
  EXPECT_EQ(judgeReciprocal(t, blind, noticed).kind, Kind::Expected);
  // What is consistent only is told how far off it is.
  ReciprocalTraits consistent = t;
  consistent.bias = EstimatorTraits::Bias::Consistent;
  EXPECT_EQ(judgeReciprocal(consistent, setting, resultOf(biased, 2)).reason,
            "consistent: relative error -0.25");
}

TEST(Heatmap, TheBestIsTheLeastAndRoundingCountsAsNothing) {
  Heatmap map{
      .width = 2,
      .height = 1,
      .layers = {{"a", std::vector<Heatmap::Pixel>(2), true}, {"b", std::vector<Heatmap::Pixel>(2), true}}};
  const auto set = [&](std::size_t layer, std::size_t pixel, double variance, double lookups) {
    Heatmap::Pixel& p = map.layers[layer].pixels[pixel];
    p.exact = p.mean = 0.5;
    p.variance = variance;
    p.lookups = lookups;
    p.seconds = lookups;
    p.trials = 10;
  };
  set(0, 0, 0.2, 1);
  set(1, 0, 0.1, 3);
  EXPECT_EQ(map.best(0, Heatmap::Measure::Variance), 1u);
  EXPECT_EQ(map.best(0, Heatmap::Measure::VarianceLookups), 0u);
  EXPECT_EQ(map.best(1, Heatmap::Measure::Variance), Heatmap::kNoBest);
  set(0, 1, 0, 3);
  set(1, 1, 1e-22, 2);
  EXPECT_EQ(map.best(1, Heatmap::Measure::Variance), 1u);
  map.layers[1].pixels[1].mean = 0.4;  // rare events were missed
  EXPECT_EQ(map.best(1, Heatmap::Measure::Variance), 0u);
  map.layers[0].isUnbiased = false;
  EXPECT_EQ(map.best(1, Heatmap::Measure::Variance), Heatmap::kNoBest);
  map.layers[0].isUnbiased = true;
  EXPECT_EQ(map.row(0), 1);
  EXPECT_DOUBLE_EQ(map.column(0), 0.99);
  EXPECT_NEAR(map.column(1), 0.01, 1e-15);
  const Image picture = heatmapPicture(map, Heatmap::Measure::Variance, "test");
  EXPECT_GT(picture.width(), 400);
  const Image channels = heatmapChannels(map, "medialab", true);
  EXPECT_EQ(channels.channelCount(), 9u);
  EXPECT_EQ(channels.at(0, 0, *channels.channelIndex("b.variance")), 0.1f);
  EXPECT_EQ(channels.at(0, 0, *channels.channelIndex("best.variance_lookups")), 0.0f);
}

TEST(LabCanvas, LightnessOfTheScaleRisesEvenly) {
  const auto luminance = [](Rgb c) {
    return 0.2126f * decodeSrgb(c.r) + 0.7152f * decodeSrgb(c.g) + 0.0722f * decodeSrgb(c.b);
  };
  float last = -1;
  for (int i = 0; i <= 100; ++i) {
    const float y = luminance(sequentialColour(i / 100.0));
    EXPECT_GT(y, last);
    last = y;
  }
}

TEST(LabCanvas, DrawsTextAndCutsItAtTheEdge) {
  LabCanvas canvas(20, 9);
  canvas.text(0, 0, "II long", {0, 0, 0});
  EXPECT_EQ(canvas.image().rgb(2, 3), Rgb(0));
  EXPECT_EQ(canvas.image().rgb(0, 3), Rgb(1));
  EXPECT_EQ(canvas.image().rgb(8, 3), Rgb(0));
}

}  // namespace
}  // namespace pbrtmedia
