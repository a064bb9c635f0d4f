// SPDX-License-Identifier: BSD-2-Clause
// What the papers' figures ask of the lab: reciprocals, axes of maps, levels, running weights, power laws,
// and bounds that rise.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "support/process.h"
#include "support/z_test.h"

namespace pbrtmedia {
namespace {

using nlohmann::json;
using test::kMaxAbsZ;
using test::ProcessResult;

ProcessResult lab(const std::string& arguments) {
  return test::run("'" PBRT_MEDIA_MEDIALAB "' " + arguments);
}
json labJson(const std::string& arguments) {
  const ProcessResult result = lab(arguments + " --format json --quiet --no-seconds");
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(result.output);
}
json rowsOf(const std::string& arguments) { return labJson(arguments)["rows"]; }

/// |found - expected| within kMaxAbsZ standard errors.
void expectWithin(const json& row, const char* found, double expected, const char* error) {
  EXPECT_LT(std::abs(row[found].get<double>() - expected), kMaxAbsZ * row[error].get<double>() + 1e-12)
      << row;
}

TEST(MedialabReciprocals, HaveTheirOwnListAndAnswer) {
  const json list = json::parse(lab("list reciprocals --format json").output)["reciprocals"];
  ASSERT_EQ(list.size(), 5u);
  const json document = labJson(
      "estimate --quantity reciprocal --extinction composite-sine,step --depth 0.5,2 --control 1.5 "
      "--trials 20000");
  EXPECT_EQ(document["rows"].size(), list.size() * 4);
  EXPECT_NE(document["notes"].dump().find("quantity: reciprocal"), std::string::npos);
  for (const json& row : document["rows"]) {
    EXPECT_DOUBLE_EQ(row["exact"].get<double>(), 1 / row["depth"].get<double>());
    if (row["estimator"] == "reciprocal-march") continue;
    expectWithin(row, "mean", row["exact"], "mean_stderr");
  }
}

TEST(MedialabReciprocals, BernoulliTrialsHaveTheirClosedForms) {
  // 1 / F with p = F / alpha: variance (1 - p) / F^2, look-ups 1 / p.
  for (const json& row :
       rowsOf("estimate --estimator reciprocal-bernoulli,reciprocal-p-cumulative "
              "--extinction cosine,gaussian --depth 2 --efficiency 0.1,0.05 --trials 40000")) {
    const double p = 1 / (row["control"].get<double>() *
                          (row["extinction"] == "cosine" ? 2 / 1.0105719571588858 : 7.97884560864852));
    expectWithin(row, "variance", (1 - p) / 4, "variance_stderr");
    EXPECT_NEAR(row["lookups"].get<double>() * p, 1, .03) << row;
  }
}

TEST(MedialabReciprocals, AreNotMixedWithTransmittance) {
  const auto fails = [](const std::string& arguments, const std::string& part) {
    const ProcessResult result = lab(arguments);
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  };
  fails("estimate --estimator ratio,reciprocal-taylor", "estimators of different quantities");
  fails("estimate --quantity reciprocal --estimator ratio", "ratio estimates the transmittance");
  fails("estimate --quantity reciprocal --law pinknoise", "a law turns depth into transmittance");
  fails("stress --estimator ratio,reciprocal-taylor", "estimators of different quantities");
  fails("stress --quantity transmittance --estimator reciprocal-taylor",
        "reciprocal-taylor estimates the reciprocal");
  fails("estimate --estimator reciprocal-tailor", "\"reciprocal-taylor\"");
}

TEST(MedialabReciprocals, QuickStressHasNoFailure) {
  std::map<std::string, std::map<std::string, json>> cells;
  for (const json& row : rowsOf("stress --quantity reciprocal --quick")) {
    EXPECT_NE(row["verdict"], "fail") << row;
    EXPECT_FALSE(row["verdict"] == "skipped" && row["reason"].get<std::string>().empty()) << row;
    cells[row["estimator"]][row["case"]] = row;
  }
  ASSERT_EQ(cells.size(), 5u);
  const auto verdict = [&](const char* estimator, const char* one) {
    return cells[estimator][one]["verdict"];
  };
  for (const auto& [estimator, of] : cells) {
    EXPECT_GT(of.size(), 15u);
    EXPECT_EQ(verdict(estimator.c_str(), "depth-1e-100"), "pass") << estimator;
    EXPECT_EQ(verdict(estimator.c_str(), "depth-1e+100"), "pass") << estimator;
    EXPECT_EQ(verdict(estimator.c_str(), "depth-0"), "pass") << estimator << " is infinite there";
    EXPECT_EQ(verdict(estimator.c_str(), "no-density"), "pass") << estimator;
  }
  EXPECT_EQ(verdict("reciprocal-bernoulli", "control-0.6"), "expected");
  EXPECT_EQ(verdict("reciprocal-p-cumulative", "control-0.6"), "pass");
  EXPECT_EQ(verdict("reciprocal-p-cumulative", "control-0.3"), "expected");
  EXPECT_EQ(verdict("reciprocal-p-cumulative", "control-1e+09"), "skipped");
  EXPECT_EQ(verdict("reciprocal-telescoping", "control-1e+09"), "pass");
  EXPECT_EQ(verdict("reciprocal-telescoping", "touches-0"), "expected");
  EXPECT_EQ(verdict("reciprocal-bernoulli", "blind-supervoxel"), "expected");
}

TEST(MedialabReciprocals, MapOverTheAnswerAndTheControl) {
  const json rows = rowsOf(
      "heatmap --quantity reciprocal --estimator reciprocal-bernoulli --extinction cosine --rows "
      "control --width 3 --height 2 --range 0.9 0.1 --row-range 1 5 --trials 4000");
  ASSERT_EQ(rows.size(), 6u);
  for (const json& row : rows) {
    const double answer = row["reciprocal"], control = row["control"];
    EXPECT_NEAR(row["exact"].get<double>(), answer, 1e-12);
    const double p = 1.0105719571588858 / (2 * control);
    EXPECT_NEAR(row["variance"].get<double>(), (1 - p) * answer * answer, .25 * answer * answer * (1 - p))
        << row;
  }
  EXPECT_EQ(rows[0]["control"], 5);
  EXPECT_EQ(rows[5]["control"], 1);
  EXPECT_NEAR(rows[2]["reciprocal"].get<double>(), .1, 1e-12);
}

TEST(MedialabHeatmap, TakesItsRangesAndPinkNoiseColumns) {
  const json rows = rowsOf(
      "heatmap --estimator ray-marching --law pinknoise --param correlation=0.8 --extinction "
      "constant --width 4 --height 2 --range 0.8 0.2 --row-range 0.1 0.4 --lookups 100");
  ASSERT_EQ(rows.size(), 8u);
  for (int x = 0; x < 4; ++x) {
    const double p = .8 - .2 * x;
    EXPECT_NEAR(rows[static_cast<std::size_t>(x)]["transmittance"].get<double>(), p, 1e-12);
    EXPECT_NEAR(rows[static_cast<std::size_t>(x)]["mean"].get<double>(), p, 1e-12);
    EXPECT_NEAR(rows[static_cast<std::size_t>(x)]["efficiency"].get<double>(), .4, 1e-12);
  }
  EXPECT_NEAR(rows[7]["efficiency"].get<double>(), .1, 1e-12);
  EXPECT_EQ(lab("heatmap --range 2 0.1 --width 2 --height 2").status, 1);
}

TEST(MedialabHeatmap, MapsAFamilyOfDensities) {
  const json rows = rowsOf(
      "heatmap --family slab --estimator ratio,regular --width 5 --height 3 --control 2 --trials 4000");
  ASSERT_EQ(rows.size(), 15u);  // not piecewise cubic, so none of regular tracking
  for (const json& row : rows) {
    EXPECT_NEAR(row["exact"].get<double>(), std::exp(-row["depth"].get<double>()), 1e-12);
    EXPECT_NEAR(row["slab"].get<double>(), row["x"].get<double>() / 4, 1e-12);
    expectWithin(row, "mean", row["exact"], "mean_stderr");
  }
  EXPECT_EQ(rows[14]["depth"], 0);
  EXPECT_DOUBLE_EQ(rows[0]["depth"].get<double>(), 9.9);
  // Rougher to the right: a higher maximum, so a deeper control.
  EXPECT_GT(rows[4]["lookups"].get<double>(), 1.1 * rows[0]["lookups"].get<double>());
  const json shared = rowsOf(
      "heatmap --family slab --estimator ratio --width 5 --height 3 --control 2 --shared-control "
      "--trials 4000");
  EXPECT_NEAR(shared[0]["lookups"].get<double>() / shared[4]["lookups"].get<double>(), 1, .02);
  EXPECT_EQ(lab("heatmap --family slap").status, 1);
}

TEST(MedialabLower, ControlsInOpticalDepthWorkWhereFunctionsTouchNothing) {
  // Residual ratio tracking on 2 x at depth 1 under a constant control of depth 3, with a lower one of depth
  // c: T^2 expm1(integral of (2 x - c)^2 / (3 - c)), the integral being (4/3 - 2 c + c^2) / (3 - c).
  const json rows = rowsOf(
      "estimate --estimator residual-ratio --extinction linear-up --depth 1 --control 1.5 "
      "--lower-depth 0,0.5,1 --trials 100000");
  ASSERT_EQ(rows.size(), 3u);
  for (const json& row : rows) {
    const double c = row["lower_depth"], integral = (4. / 3 - 2 * c + c * c) / (3 - c);
    expectWithin(row, "mean", std::exp(-1), "mean_stderr");
    expectWithin(row, "variance", std::exp(-2) * std::expm1(integral), "variance_stderr");
    EXPECT_NEAR(row["lookups"].get<double>(), 3 - c, .05);
  }
}

TEST(MedialabLevels, CorrectionsOfIndependentLookUpsFallAsTheySay) {
  std::map<std::string, double> slope;
  const json document = labJson(
      "levels --estimator debiased-ray-marching:levels=0:comb=independent --extinction cosine "
      "--levels 7 --trials 20000");
  ASSERT_EQ(document["rows"].size(), 14u);
  std::map<std::string, std::vector<double>> variance;
  for (const json& row : document["rows"]) {
    variance[row["coupling"]].push_back(row["variance"]);
    const double teeth = std::exp2(row["level"].get<double>());
    EXPECT_EQ(row["teeth"].get<double>(), teeth);
    EXPECT_EQ(row["lookups"].get<double>(), (row["coupling"] == "split" ? 2 : 3) * teeth);
    EXPECT_NEAR(row["probability"].get<double>(), .65 * std::pow(.35, row["level"].get<double>()), 1e-12);
  }
  // 4^-j for halves of one set of points, 2^-j for sets of their own.
  EXPECT_NEAR(std::log2(variance["split"][3] / variance["split"][6]) / 3, 2, .25);
  EXPECT_NEAR(std::log2(variance["independent"][3] / variance["independent"][6]) / 3, 1, .15);
  const json combs = rowsOf("levels --extinction cosine --levels 5 --trials 2000");
  EXPECT_LT(combs[4]["variance"].get<double>(), combs[0]["variance"].get<double>() * std::pow(16., -4));
}

TEST(MedialabLevels, SumToTheAnswerFromTheCoarseMarch) {
  double sum = 0, error = 0;
  for (const json& row :
       rowsOf("levels --estimator reciprocal-telescoping:levels=0 --extinction composite-sine --depth 2 "
              "--levels 7 --trials 10000")) {
    if (row["coupling"] != "split") continue;
    sum += row["mean"].get<double>();
    error = std::hypot(error, row["mean_stderr"].get<double>());
  }
  const json coarse = rowsOf(
      "estimate --estimator reciprocal-march:n=1 --extinction composite-sine --depth 2 --trials "
      "40000")[0];
  error = std::hypot(error, coarse["mean_stderr"].get<double>());
  EXPECT_LT(std::abs(sum + coarse["mean"].get<double>() - .5), kMaxAbsZ * error);
  EXPECT_EQ(lab("levels --estimator ratio").status, 1);
}

TEST(MedialabRunning, RatioTrackingWalksThroughItsWeights) {
  // Control 0.7 and 0.3 times a constant: the weight after n events is (1 - 1 / 0.7)^n, and so on.
  for (const double control : {1.3, .7, .3}) {
    const std::string number = std::to_string(control);
    std::map<std::string, double> last, count;
    for (const json& row :
         rowsOf("running --extinction constant --depth 4 --points 50 --runs 20 --curves 20 --control " +
                number)) {
      const std::string run = row["run"];
      const double value = row["value"];
      if (run == "mean" || run == "stderr") continue;
      if (run == "exact") {
        EXPECT_NEAR(value, std::exp(-4 * row["s"].get<double>()), 1e-12);
        continue;
      }
      const double before = last.count(run) > 0 ? last[run] : 1, factor = 1 - 1 / control;
      last[run] = value;
      const double events = std::log(std::abs(value)) / std::log(std::abs(factor));
      EXPECT_NEAR(events, std::round(events), 1e-6) << row;
      EXPECT_GE(std::round(events), std::round(count[run])) << "weights only gain factors";
      count[run] = events;
      EXPECT_EQ(value > 0, factor > 0 || std::lround(events) % 2 == 0) << row;
      EXPECT_TRUE(value == before || std::abs(value) != std::abs(before));
    }
    EXPECT_EQ(last.size(), 20u);
  }
}

TEST(MedialabRunning, HasTheTransmittanceOfTheStepOfSines) {
  // Misso et al. 2023, figure 2: T(0, 1) = 0.8123, T(0, 3) = 0.0016.
  const json rows = rowsOf(
      "running --extinction step-sine --depth 12.661604218246856 --control 1.0883644 --points 5 "
      "--runs 4000 --curves 0");
  std::map<double, std::map<std::string, double>> at;
  for (const json& row : rows) at[row["s"]][row["run"]] = row["value"];
  ASSERT_EQ(at.size(), 5u);
  EXPECT_NEAR(at[1]["exact"], .8123, 5e-5 + 5 * 5e-7);  // its five amplitudes are printed to six digits
  EXPECT_NEAR(at[3]["exact"], .0016, 5e-5);
  for (auto& [s, values] : at) {
    EXPECT_LT(std::abs(values["mean"] - values["exact"]), kMaxAbsZ * values["stderr"] + 1e-12) << s;
  }
}

TEST(MedialabPowerLaw, SlopesAreThoseOfFiniteAndInfiniteVariance) {
  // From alpha = 3/4 on the errors' own variance is so large that slopes need millions of trials.
  std::map<double, json> last;
  for (const json& row : rowsOf("power-law --alpha 0.3,0.6,0.75 --doublings 12 --trials 2000")) {
    last[row["alpha"]] = row;
  }
  ASSERT_EQ(last.size(), 3u);
  for (const auto& [alpha, row] : last) {
    EXPECT_NEAR(row["slope"].get<double>(), row["expected_slope"].get<double>(), .05) << row;
    EXPECT_NEAR(row["expected_slope"].get<double>(), std::max(-.5, alpha - 1), 1e-12);
    EXPECT_EQ(row["samples"], 4096);
  }
  EXPECT_EQ(lab("power-law --alpha 1").status, 1);
}

TEST(MedialabProgressive, LearnedBoundsHoldInTheEndAndTheBiasGoes) {
  const json rows =
      rowsOf("progressive --supervoxels 16 --start 0.2 --passes 100 --per-pass 32 --repeats 64 --depth 2");
  ASSERT_EQ(rows.size(), 100u);
  const json &first = rows.front(), &tenth = rows[9], &last = rows.back();
  EXPECT_EQ(first["bounded_share"], 0);
  EXPECT_NEAR(first["control_depth"].get<double>(), .2, 1e-12);
  EXPECT_NEAR(first["pass_mean"].get<double>(), std::exp(-.2), 5 * first["pass_mean_stderr"].get<double>())
      << "clamped: as clear as the control";
  EXPECT_EQ(last["bounded_share"], 1);
  expectWithin(last, "pass_mean", std::exp(-2), "pass_mean_stderr");
  double before = 0;
  for (const json& row : rows) {
    EXPECT_GE(row["control_depth"].get<double>(), before);
    before = row["control_depth"];
  }
  // Passes of the beginning weigh less and less in the average.
  const auto bias = [](const json& row) { return row["mean"].get<double>() - std::exp(-2); };
  EXPECT_GT(bias(tenth), 20 * tenth["mean_stderr"].get<double>());
  EXPECT_LT(bias(last), .3 * bias(tenth));
}

TEST(MedialabProgressive, RisingBoundsReachTheirLimitAndUnclampedOnesNeverBias) {
  const json rising = rowsOf(
      "progressive --update rising --start 0.1 --rise 0.5 --most 3 --passes 20 --repeats 64 "
      "--per-pass 16 --supervoxels 1 --depth 1");
  EXPECT_DOUBLE_EQ(rising[0]["control_depth"].get<double>(), .1);
  EXPECT_DOUBLE_EQ(rising[3]["control_depth"].get<double>(), 1.6);
  EXPECT_DOUBLE_EQ(rising[19]["control_depth"].get<double>(), 3);
  EXPECT_EQ(rising[3]["bounded_share"], 0);  // the maximum is 1.6463
  EXPECT_EQ(rising[4]["bounded_share"], 1);
  for (std::size_t i = 4; i < 20; ++i) expectWithin(rising[i], "pass_mean", std::exp(-1), "pass_mean_stderr");
  const json unclamped = rowsOf(
      "progressive --update rising --start 1.2 --rise 0 --passes 2 --repeats 256 --per-pass 64 "
      "--supervoxels 1 --depth 1 --unclamped");
  expectWithin(unclamped[1], "mean", std::exp(-1), "mean_stderr");
  const json clamped = rowsOf(
      "progressive --update rising --start 0.8 --rise 0 --passes 2 --repeats 256 --per-pass 64 "
      "--supervoxels 1 --depth 1");
  EXPECT_GT(clamped[1]["mean"].get<double>(), std::exp(-1) + 10 * clamped[1]["mean_stderr"].get<double>());
}

TEST(MedialabFigures, DoNotDependOnThreads) {
  for (const std::string command :
       {"levels --levels 3 --trials 2000", "running --points 4 --runs 50 --curves 3",
        "power-law --doublings 6 --trials 100", "progressive --passes 5 --repeats 20",
        "heatmap --family slab --estimator ratio --width 3 --height 2 --trials 50"}) {
    const ProcessResult one = lab(command + " --quiet --no-seconds --threads 1");
    EXPECT_EQ(one.status, 0) << one.output;
    EXPECT_EQ(lab(command + " --quiet --no-seconds --threads 5").output, one.output);
  }
}

TEST(MedialabPublished, ElementaryMeansOfTheCodeAreBiased) {
  // The published estimator of Kettunen et al. 2021 on gaussian-m22 at T = 0.5 under the control 2.765: 7
  // look-ups a comb, 9.24 in all, a mean square error of 7.7e-10.
  const std::string common =
      "estimate --extinction gaussian-m22 --depth 0.6931471805599453 --control 1 --trials ";
  const json published = rowsOf(common +
                                "400000 --estimator unbiased-ray-marching:elementarymeans=published:"
                                "endpointmatching=off:warp=off")[0];
  const double bias = published["mean"].get<double>() - .5;
  EXPECT_NEAR(published["lookups"].get<double>(), 9.24, .02);
  EXPECT_NEAR((published["variance"].get<double>() + bias * bias) / 7.7e-10, 1, .15) << published;
  // On a rough density the bias shows; the exact means have none.
  const std::string rough =
      "estimate --extinction fractal-a --depth 1.5 --control 1 --trials 400000 --param tuplesize=2 "
      "--param endpointmatching=off --param warp=off --estimator unbiased-ray-marching";
  const json wrong = rowsOf(rough + ":elementarymeans=published")[0], right = rowsOf(rough)[0];
  EXPECT_GT(std::abs(wrong["mean"].get<double>() - std::exp(-1.5)),
            kMaxAbsZ * wrong["mean_stderr"].get<double>());
  expectWithin(right, "mean", std::exp(-1.5), "mean_stderr");
}

TEST(MedialabPublished, LevelCountOfTheCodeIsThatOfTheTable) {
  const double expected[][3] = {
      {.1, 1.052, 2.034}, {1, 4.239, 5.194}, {5, 11.662, 12.588}, {20, 32.503, 33.405}};
  for (const auto& [depth, printed, code] : expected) {
    const json rows = rowsOf(
        "estimate --estimator p-series-cmf:levelcount=printed,p-series-cmf --extinction linear-up "
        "--control 1 --trials 20000 --depth " +
        std::to_string(depth / 2));
    EXPECT_NEAR(rows[0]["lookups"].get<double>() / printed, 1, .02) << depth;
    EXPECT_NEAR(rows[1]["lookups"].get<double>() / code, 1, .02) << depth;
  }
}

TEST(MedialabMedium, OfSzirmayKalosHasTheVariancesOfItsTable) {
  const double expected[][2] = {{.8, 1.144e-2}, {1, 6.589e-3}, {2, 1.798e-3}};
  for (const auto& [rate, variance] : expected) {
    const json row = rowsOf(
        "estimate --extinction szirmay-kalos --depth 3.4156842601 --trials 100000 --estimator "
        "random-medium:explorers=0:samplingextinction=" +
        std::to_string(rate))[0];
    expectWithin(row, "mean", std::exp(-3.4156842601), "mean_stderr");
    expectWithin(row, "variance", variance, "variance_stderr");
    EXPECT_NEAR(row["lookups"].get<double>() / (20 * rate), 1, .01);
  }
}

}  // namespace
}  // namespace pbrtmedia
