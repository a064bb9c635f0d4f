// SPDX-License-Identifier: BSD-2-Clause
// Runs the built medialab, as a user would.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/image.h"
#include "support/process.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"
#include "support/z_test.h"

namespace pbrtmedia {
namespace {

using nlohmann::json;
using test::ProcessResult;

ProcessResult lab(const std::string& arguments, const std::string& folder = ".") {
  return test::run("cd '" + folder + "' && '" PBRT_MEDIA_MEDIALAB "' " + arguments);
}

json labJson(const std::string& arguments) {
  const ProcessResult result = lab(arguments + " --format json --quiet");
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(result.output);
}

void expectIn(const ProcessResult& result, const std::string& part) {
  EXPECT_NE(result.output.find(part), std::string::npos) << "expected " << part << " in\n" << result.output;
}

TEST(Medialab, HelpAndMistakesHaveTheRightStatus) {
  EXPECT_EQ(lab("--help").status, 0);
  for (const char* command : {"list", "estimate", "heatmap", "converge", "profile", "levels", "running",
                              "power-law", "progressive", "stress", "precision", "docs"}) {
    EXPECT_EQ(lab(std::string(command) + " --help").status, 0);
  }
  EXPECT_EQ(lab("").status, 1);
  const ProcessResult unknown = lab("estimat");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_EQ(
      unknown.output.find("medialab: error: unknown command \"estimat\"; did you mean \"estimate\"? known: "),
      0u)
      << unknown.output;
  const ProcessResult version = lab("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.output.find("pbrt-media "), 0u) << version.output;
  expectIn(version, ", commit ");
  EXPECT_EQ(lab("estimate --unknown").status, 1);
}

/// Killed and begun again until it ends by itself, wherever that hits it.
TEST(Medialab, GoesOnWhereItWasKilled) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  for (const std::string command :
       {"estimate --extinction cosine,gaussian --trials 20000", "converge --doublings 6 --trials 400",
        "heatmap --extinction gaussian --estimator ratio,residual-ratio,track-length --width 16 --height "
        "16"}) {
    const std::string what = command + " --quiet --no-seconds -o t.csv";
    ASSERT_EQ(lab(what, in).status, 0);
    const std::string whole = test::run("cat '" + in + "/t.csv' && rm '" + in + "/t.csv'").output;
    int kills = 0;
    for (double seconds = 0.02; kills < 200; ++kills, seconds *= 1.2) {
      const ProcessResult r = test::run("cd '" + in + "' && timeout -s KILL " + std::to_string(seconds) +
                                        " '" + PBRT_MEDIA_MEDIALAB "' " + what + " --resume journal");
      if (r.status == 0) break;
    }
    EXPECT_GT(kills, 0) << command;
    EXPECT_EQ(test::run("cat '" + in + "/t.csv'").output, whole) << command;
    const ProcessResult other = lab(command + "0 --quiet --resume journal", in);
    EXPECT_EQ(other.status, 1) << command;
    expectIn(other, "belongs to other measurements");
    std::filesystem::remove(folder.path() / "journal");
  }
}

TEST(Medialab, ErrorsTellTheNearestNames) {
  const auto fails = [](const std::string& arguments, const std::vector<std::string>& parts) {
    const ProcessResult result = lab(arguments + " --trials 10");
    EXPECT_EQ(result.status, 1) << arguments;
    for (const std::string& part : parts) expectIn(result, part);
  };
  fails("estimate --estimator ratoi", {"unknown estimator \"ratoi\"", "did you mean \"ratio\"?"});
  fails("estimate --extinction cosin", {"unknown extinction function \"cosin\"", "\"cosine\""});
  fails("estimate --law pink", {"unknown law \"pink\"", "pinknoise"});
  fails("estimate --estimator ratio --law pinknoise",
        {"ratio cannot serve the law pinknoise", "exponential"});
  fails("estimate --estimator ratio --param stepsize=1",
        {"ratio has no parameter \"stepsize\"", "roulettethreshold", "estimators that have it",
         "ray-marching"});
  fails("estimate --param nosuchparameter=1", {"no estimator has a parameter \"nosuchparameter\""});
  fails("estimate --estimator ratio --param roulettethreshold", {"expected name=value"});
  fails("estimate --estimator ratio --param roulettethreshold=2", {"found 2, expected a number 0 to 1"});
  fails("estimate --estimator ratio:nothing=1", {"ratio has no parameter \"nothing\""});
  fails("estimate --estimator ratio,all", {"\"all\" stands for every estimator"});
  fails("estimate --depth=-1", {"--depth", "found -1"});
  fails("estimate --control 0", {"--control", "found 0"});
  fails("estimate --estimator regular --extinction cosine", {"nothing could be run", "cubic"});
  EXPECT_EQ(lab("estimate --trials 1").status, 1);
  EXPECT_EQ(lab("stress --case nosuchcase").status, 1);
}

TEST(Medialab, NumbersHaveRanges) {
  for (const char* arguments : {"estimate --trials -5",
                                "estimate --trials 99999999999999999999",
                                "estimate --trials 1",
                                "estimate --trials 1e3",
                                "estimate --samples-per-estimate 0",
                                "estimate --seed -1",
                                "estimate --nthreads -1",
                                "estimate --threads 99999",
                                "estimate --depth nan",
                                "estimate --depth 1,-1",
                                "estimate --control 0",
                                "estimate --efficiency inf",
                                "estimate --lower=-1",
                                "estimate --supervoxels 0",
                                "estimate --length 0",
                                "estimate --offset nan",
                                "heatmap --width 0",
                                "heatmap --height 5000",
                                "heatmap --range 0 1",
                                "heatmap --row-range -1 1",
                                "heatmap --lookups 0",
                                "heatmap --trials 1",
                                "converge --doublings 25",
                                "converge --trials 3",
                                "profile --points 1",
                                "docs --trials 0",
                                "stress --seed x"}) {
    const ProcessResult result = lab(arguments);
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_EQ(result.output.find("medialab: error: --"), 0u) << result.output;
    expectIn(result, ": found ");
    expectIn(result, ", expected a ");
    EXPECT_LT(result.output.find('\n'), 120u) << "a short range: " << result.output;
  }
}

TEST(Medialab, TheNameOfTheFileSaysTheFormat) {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  const std::string command = "estimate --estimator ratio --extinction cosine --trials 10 --quiet ";
  ASSERT_EQ(lab(command + "-o a.json", path).status, 0);
  EXPECT_EQ(json::parse(folder.read("a.json"))["rows"].size(), 1u);
  ASSERT_EQ(lab(command + "-o a.csv", path).status, 0);
  EXPECT_EQ(folder.read("a.csv").substr(0, 10), "# medialab");
  ASSERT_EQ(lab(command + "-o a.txt --format json", path).status, 0);
  EXPECT_EQ(json::parse(folder.read("a.txt"))["rows"].size(), 1u);
  ASSERT_EQ(lab(command + "-o c.txt", path).status, 0);
  EXPECT_EQ(folder.read("c.txt").substr(0, 22), "estimator  extinction ");
  EXPECT_EQ(lab(command + "--format text").output.substr(0, 22), "estimator  extinction ");
  EXPECT_EQ(lab(command).output.substr(0, 10), "# medialab") << "no terminal";
  for (const char* wrong : {"-o b.dat", "-o b", "-o b.json --format csv", "-o b.csv --format json"}) {
    const ProcessResult result = lab(command + wrong, path);
    EXPECT_EQ(result.status, 1) << wrong;
    EXPECT_EQ(result.output.find("medialab: error: b"), 0u) << result.output;
  }
  EXPECT_EQ(lab("docs --trials 2 --quiet -o page.csv", path).status, 1);
  EXPECT_EQ(lab("profile --quiet --estimator ratio --picture plot.jpg", path).status, 1);
  ASSERT_EQ(
      lab("heatmap --estimator ratio --width 2 --height 2 --lookups 100 --quiet -o map.json", path).status,
      0);
  EXPECT_EQ(json::parse(folder.read("map.json"))["rows"].size(), 4u);
  EXPECT_TRUE(folder.has("map.exr"));
  EXPECT_FALSE(folder.has("b.txt") || folder.has("b") || folder.has("b.json") || folder.has("plot.jpg"));
}

TEST(Medialab, OutputsAreProbedBeforeAnythingIsMeasured) {
  // What these measure would take hours.
  const std::string trials = " --trials 100000000000 --extinction cosine --estimator ratio ";
  const std::vector<std::string> commands = {"estimate -o no/a.csv" + trials,
                                             "converge -o no/a.json" + trials,
                                             "heatmap -o no/a" + trials,
                                             "heatmap -o no/a.csv" + trials,
                                             "docs --trials 100000000000 -o no/a.md",
                                             "stress -o no/a.csv",
                                             "precision -o no/a.csv",
                                             "profile --picture no/a.png",
                                             "profile -o no/a.csv"};
  for (const std::string& command : commands) {
    const ProcessResult r = lab(command);
    EXPECT_EQ(r.status, 1) << command;
    EXPECT_EQ(r.output.find("medialab: error: cannot write \"no/a"), 0u) << command << r.output;
  }
  const TemporaryFolder folder;
  EXPECT_EQ(lab("estimate --trials 10 --extinction cosine --estimator ratio --quiet -o A.JSON",
                folder.path().string())
                .status,
            0);
  EXPECT_EQ(folder.read("A.JSON").front(), '{');
}

TEST(Medialab, ThreadsHaveOneWord) {
  const std::string command =
      "estimate --estimator ratio --extinction cosine --trials 10 --quiet --no-seconds ";
  const ProcessResult plain = lab(command);
  for (const char* words : {"--nthreads 2", "--nthreads=2", "--threads 2", "--threads=2"}) {
    EXPECT_EQ(lab(command + words).output, plain.output) << "nor does the command in the output say it";
  }
}

TEST(Medialab, HeatmapsAreLabelledByTheirLaw) {
  for (const char* law : {"exponential", "pinknoise", "linear", "davis", "mixture"}) {
    const json document = labJson(std::string("heatmap --estimator ray-marching --law ") + law +
                                  " --extinction constant --width 7 --height 2 --lookups 200");
    ASSERT_EQ(document["rows"].size(), 14u) << law;
    for (const json& row : document["rows"]) {
      EXPECT_NEAR(row["transmittance"].get<double>(), row["exact"].get<double>(), 1e-12) << law;
      EXPECT_NEAR(row["mean"].get<double>(), row["exact"].get<double>(), 1e-12)
          << "exact on a constant: " << law;
    }
    EXPECT_NE(document["notes"].dump().find(std::string("law of the transmittance: ") + law),
              std::string::npos);
  }
  const ProcessResult never =
      lab("heatmap --estimator ray-marching --law mixture --param thin=0 --width 2 --height 2 --quiet");
  EXPECT_EQ(never.status, 1);
  expectIn(never, "never falls to the transmittance 0.01");
}

TEST(Medialab, RowsOfSeveralLawsSayWhose) {
  const json rows =
      labJson("estimate --estimator ratio,pink-p-cumulative --extinction cosine --trials 10")["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["law"], "exponential");
  EXPECT_EQ(rows[1]["law"], "pinknoise");
}

TEST(Medialab, ListsEverythingThereIs) {
  const json list = json::parse(lab("list --format json").output);
  std::size_t withParameters = 0;
  for (const json& e : list["estimators"]) {
    for (const char* key : {"name", "summary", "source", "useWhen", "bias", "control"}) {
      EXPECT_FALSE(e[key].get<std::string>().empty()) << e["name"] << ' ' << key;
    }
    EXPECT_FALSE(e["laws"].empty());
    withParameters += e["parameters"].empty() ? 0 : 1;
  }
  EXPECT_GT(withParameters, 0u);
  for (const json& f : list["functions"]) EXPECT_GE(f["max"].get<double>(), f["min"].get<double>());
  EXPECT_EQ(list["patterns"].size(), 5u);
  const ProcessResult text = lab("list");
  EXPECT_EQ(text.status, 0);
  for (const char* kind : {"estimators", "reciprocals", "flights", "functions", "laws"}) {
    for (const json& one : list[kind]) expectIn(text, "  " + one["name"].get<std::string>());
  }
  EXPECT_EQ(json::parse(lab("list laws --format json").output).size(), 1u);
}

TEST(Medialab, ThePageOfEstimatorsKnowsAllOfThem) {
  std::ifstream in(test::sourceDir() / "docs/estimators.md");
  std::stringstream page;
  page << in.rdbuf();
  const json list = json::parse(lab("list --format json").output);
  for (const char* kind : {"estimators", "reciprocals", "laws"}) {
    for (const json& one : list[kind]) {
      const std::string heading = "\n### `" + one["name"].get<std::string>() + "`\n";
      EXPECT_NE(page.str().find(heading), std::string::npos) << heading << "run medialab docs";
    }
  }
  for (const json& one : list["flights"]) {
    const std::string row =
        "\n| `" + one["name"].get<std::string>() + "` | " + one["bias"].get<std::string>();
    EXPECT_NE(page.str().find(row), std::string::npos) << row << ": run medialab docs";
  }
}

TEST(Medialab, ThePageOfEstimatorsIsWrittenByItsCommand) {
  const TemporaryFolder one, two;
  const std::string command = "docs --trials 50 --no-seconds --quiet -o page.md --threads ";
  EXPECT_EQ(lab(command + "1", one.path().string()).status, 0);
  EXPECT_EQ(lab(command + "2", two.path().string()).status, 0);
  EXPECT_TRUE(one.read("page.md") == two.read("page.md")) << "threads do not matter";
  // Every sentence of the page in the repository comes from the command; measured numbers differ.
  EXPECT_EQ(lab("docs --trials 50 --quiet -o estimators.md", one.path().string()).status, 0);
  const std::string page = one.read("estimators.md");
  std::ifstream kept(test::sourceDir() / "docs/estimators.md");
  std::size_t sentences = 0;
  for (std::string line; std::getline(kept, line);) {
    if (line.empty() || line.find_first_of("0123456789") != std::string::npos) continue;
    if (line.starts_with("This page is generated")) continue;  // by how many trials
    ++sentences;
    EXPECT_TRUE(page.find(line + '\n') != std::string::npos) << line << ": run medialab docs";
  }
  EXPECT_GT(sentences, 100u);
}

TEST(Medialab, EstimateHasTheColumnsPromised) {
  const ProcessResult csv =
      lab("estimate --estimator ratio --extinction cosine --trials 10 --quiet --outfile - --no-such");
  EXPECT_EQ(csv.status, 1);
  const ProcessResult plain = lab("estimate --estimator ratio --extinction cosine --trials 10 --quiet");
  expectIn(plain, "# medialab estimate --estimator ratio --extinction cosine --trials 10\n");
  expectIn(
      plain,
      "\nestimator,extinction,depth,control,trials,exact,mean,mean_stderr,variance,variance_stderr,lookups,"
      "seconds_per_estimate,inverse_efficiency_lookups,inverse_efficiency_seconds,non_finite\n");
  const ProcessResult all = lab(
      "estimate --estimator ratio --extinction cosine --trials 10 --quiet --law exponential --pattern halton "
      "--lower 0 --no-seconds");
  expectIn(all,
           "\nestimator,extinction,depth,control,lower,law,pattern,trials,exact,mean,mean_stderr,variance,"
           "variance_stderr,lookups,inverse_efficiency_lookups,non_finite\n");
  const json document = labJson("estimate --estimator ratio --extinction cosine --trials 10");
  EXPECT_EQ(document["rows"].size(), 1u);
  EXPECT_EQ(document["rows"][0]["estimator"], "ratio");
  EXPECT_EQ(document["rows"][0]["trials"], 10);
}

TEST(Medialab, ResultsDoNotDependOnThreadsNorOnOtherRows) {
  const std::string arguments =
      "estimate --estimator ratio,track-length --extinction cosine,step --depth 0.5,2 --trials 3000 --quiet "
      "--no-seconds --seed 5 --samples-per-estimate 3 --pattern latinhypercube";
  const ProcessResult one = lab(arguments + " --threads 1");
  EXPECT_EQ(one.status, 0);
  EXPECT_EQ(lab(arguments + " --threads 2").output, one.output);
  EXPECT_EQ(lab(arguments + " --threads 5").output, one.output);
  EXPECT_NE(lab(arguments + " --seed 6").output, one.output);
  const ProcessResult alone =
      lab("estimate --estimator track-length --extinction step --depth 2 --trials 3000 --quiet --no-seconds "
          "--seed 5 "
          "--samples-per-estimate 3 --pattern latinhypercube");
  const std::string lastRow = alone.output.substr(alone.output.rfind('\n', alone.output.size() - 2) + 1);
  expectIn(one, lastRow);
}

TEST(Medialab, RatioTrackingHasItsVarianceAndCost) {
  // Georgiev et al. 2019, appendix D: the control of a constant is tau / e.
  for (const auto& [depth, efficiency] : {std::pair{0.693147, 0.95}, {2.302585, 0.475}, {0.105361, 0.95}}) {
    const json row =
        labJson("estimate --estimator ratio --extinction constant --trials 200000 --depth " +
                std::to_string(depth) + " --efficiency " + std::to_string(efficiency))["rows"][0];
    const double tauBar = depth / efficiency;
    const double variance = std::exp(-2 * depth) * std::expm1(depth * depth / tauBar);
    EXPECT_LT(std::abs(row["variance"].get<double>() - variance),
              test::kMaxAbsZ * row["variance_stderr"].get<double>());
    EXPECT_LT(std::abs(row["mean"].get<double>() - std::exp(-depth)),
              test::kMaxAbsZ * row["mean_stderr"].get<double>());
    // A Poisson variate: its variance is its mean.
    EXPECT_LT(std::abs(row["lookups"].get<double>() - tauBar), test::kMaxAbsZ * std::sqrt(tauBar / 200000));
    EXPECT_DOUBLE_EQ(row["inverse_efficiency_lookups"].get<double>(),
                     row["variance"].get<double>() * row["lookups"].get<double>());
  }
}

TEST(Medialab, PaperDepthIsTheFactorOfTheFormula) {
  const json row = labJson(
      "estimate --estimator track-length --extinction cosine --trials 100 --depth 1 --paper-depth "
      "--efficiency 0.45")["rows"][0];
  EXPECT_NEAR(row["exact"].get<double>(), std::exp(-1.010572), 1e-6);
  // The control's depth is 1 / 0.45, the maximum's 2.
  EXPECT_NEAR(row["control"].get<double>(), 1 / 0.9, 1e-12);
  const json own = labJson("estimate --estimator track-length --extinction cosine --trials 100")["rows"][0];
  EXPECT_NEAR(own["exact"].get<double>(), std::exp(-1.0), 1e-15);
}

TEST(Medialab, PatternsAverageWithinATrial) {
  // Track-length takes one decision more per collision; the mean of 64 has 1/64 of the variance when
  // independent, and less on a Latin hypercube.
  const std::string arguments =
      "estimate --estimator ratio --extinction constant --control 1.5 --trials 4000 --samples-per-estimate "
      "64";
  const json independent = labJson(arguments)["rows"][0],
             latin = labJson(arguments + " --pattern latinhypercube")["rows"][0];
  const double single = std::exp(-2.0) * std::expm1(1 / 1.5);
  EXPECT_LT(std::abs(independent["variance"].get<double>() - single / 64),
            test::kMaxAbsZ * independent["variance_stderr"].get<double>());
  EXPECT_LT(latin["variance"].get<double>(), 0.7 * single / 64);
  EXPECT_NEAR(independent["lookups"].get<double>(), 64 * 1.5, 2);
}

TEST(Medialab, LawsReachTheEstimatorsThatServeThem) {
  const json document = labJson(
      "estimate --estimator all --law pinknoise --param correlation=0.5 --extinction step --trials 10");
  EXPECT_FALSE(document["rows"].empty());
  for (const json& row : document["rows"]) {
    EXPECT_EQ(row["law"], "pinknoise");
    EXPECT_NEAR(row["exact"].get<double>(), std::pow(1.25, -4), 1e-12);
  }
  EXPECT_FALSE(document["skipped"].empty());
}

TEST(Medialab, ParametersMayBelongToOneEntryAlone) {
  const json rows = labJson(
      "estimate --estimator ratio,ratio:roulettethreshold=0.9 --extinction cosine --control 3 --trials 2000 "
      "--depth 3")["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1]["estimator"], "ratio:roulettethreshold=0.9");
  EXPECT_LT(rows[1]["lookups"].get<double>(), 0.9 * rows[0]["lookups"].get<double>());
}

TEST(Medialab, HeatmapFindsTheClosedFormsAndWritesItsFiles) {
  const TemporaryFolder folder;
  const ProcessResult result =
      lab("heatmap --estimator ratio,track-length --extinction constant --width 5 --height 3 --lookups 20000 "
          "--seed 3 "
          "--outfile map --format json --quiet",
          folder.path().string());
  ASSERT_EQ(result.status, 0) << result.output;
  std::ifstream in(folder.path() / "map.json");
  const json document = json::parse(in);
  EXPECT_EQ(document["rows"].size(), 30u);
  for (const json& row : document["rows"]) {
    const double t = row["transmittance"], efficiency = row["efficiency"], tau = -std::log(t),
                 n = row["trials"];
    const double tauBar = tau / efficiency;
    const bool isRatio = row["estimator"] == "ratio";
    const double variance = isRatio ? t * t * std::expm1(tau * tau / tauBar) : t - t * t;
    const double cost = isRatio ? tauBar : tauBar * (1 - t) / tau;
    // Costs are Poisson or geometric variates; the budget's end biases by 1 / n. Values of a trial that are
    // 0 or 1 with a chance of 1 % have a kurtosis of 100.
    EXPECT_NEAR(row["lookups"].get<double>() / cost, 1, 5 * std::sqrt((1 + cost) / (cost * n)) + 1 / n)
        << row;
    EXPECT_NEAR(row["variance"].get<double>() / variance, 1, 5 * std::sqrt(130 / n)) << row;
    EXPECT_TRUE(n * row["lookups"].get<double>() >= 20000 - 1e-6 || n == 80000) << row;
    const double ratio = t * t * std::expm1(tau * tau / tauBar), track = t - t * t;
    if (ratio < 0.7 * track) {
      EXPECT_EQ(row["best_variance"].get<bool>(), isRatio) << row;
    }
    const double perLookup = (1 - t) / tau;
    if (ratio < 0.7 * track * perLookup) {
      EXPECT_EQ(row["best_inverse_efficiency"].get<bool>(), isRatio) << row;
    }
    if (track * perLookup < 0.7 * ratio) {
      EXPECT_EQ(row["best_inverse_efficiency"].get<bool>(), !isRatio) << row;
    }
  }
  const Image exr = readImage(folder.path() / "map.exr");
  EXPECT_EQ(exr.width(), 5);
  EXPECT_EQ(exr.height(), 3);
  EXPECT_TRUE(exr.channelIndex("track-length.variance_lookups"));
  EXPECT_EQ(exr.metadata.at("estimators"), "ratio,track-length");
  for (const char* name : {"map-variance.png", "map-variance-lookups.png", "map-variance-seconds.png"}) {
    EXPECT_GT(readImage(folder.path() / name).width(), 300) << name;
  }
}

TEST(Medialab, HeatmapsDoNotDependOnThreads) {
  const std::string arguments =
      "heatmap --estimator ratio --extinction gaussian --width 4 --height 3 --lookups 2000 --quiet "
      "--no-seconds";
  const ProcessResult one = lab(arguments + " --threads 1");
  EXPECT_EQ(one.status, 0);
  EXPECT_EQ(lab(arguments + " --threads 5").output, one.output);
}

TEST(Medialab, IndependentEstimatesConvergeLikeTheRootOfTheirNumber) {
  const json rows =
      labJson("converge --estimator ratio --extinction cosine --depth 1 --doublings 8 --trials 1000")["rows"];
  ASSERT_EQ(rows.size(), 9u);
  const json& last = rows.back();
  for (const char* axis : {"slope_samples", "slope_lookups"}) {
    const double error = last[std::string(axis) + "_stderr"];
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 0.02);
    EXPECT_LT(std::abs(last[axis].get<double>() + 0.5), test::kMaxAbsZ * error) << axis;
  }
  EXPECT_EQ(last["samples"], 256);
  EXPECT_LT(std::abs(last["bias"].get<double>()), test::kMaxAbsZ * last["bias_stderr"].get<double>());
}

TEST(Medialab, TheErrorThatConvergesHoldsTheBias) {
  // The midpoint rule has no noise, so its error is its bias however many estimates are averaged.
  const json rows = labJson(
      "converge --estimator ray-marching:steps=2:offset=midpoint --extinction cosine --depth 2 --doublings 2 "
      "--trials 10")["rows"];
  ASSERT_EQ(rows.size(), 3u);
  for (const json& row : rows) {
    const double bias = std::abs(row["bias"].get<double>());
    EXPECT_GT(bias, 1e-4);
    EXPECT_NEAR(row["rmse"].get<double>(), bias, 1e-9 * bias);
  }
}

TEST(Medialab, ProfileShowsTheFieldAndTheLookUpsOfOneEstimate) {
  const TemporaryFolder folder;
  const ProcessResult result =
      lab("profile --estimator ratio,ray-marching --extinction step --depth 4 --control 2 --lower 1 "
          "--supervoxels 4 "
          "--points 11 --format json --quiet --picture plot.png -o profile.json",
          folder.path().string());
  ASSERT_EQ(result.status, 0) << result.output;
  std::ifstream in(folder.path() / "profile.json");
  const json document = json::parse(in);
  std::map<std::string, std::size_t> kinds;
  for (const json& row : document["rows"]) {
    ++kinds[row["kind"]];
    EXPECT_LE(row["extinction"].get<double>(), row["upper"].get<double>());
    EXPECT_GE(row["extinction"].get<double>(), row["lower"].get<double>());
    EXPECT_GE(row["s"].get<double>(), 0);
    EXPECT_LE(row["s"].get<double>(), 1);
  }
  EXPECT_EQ(kinds["field"], 11u);
  EXPECT_GT(kinds["ray-marching"], 0u);
  EXPECT_GT(readImage(folder.path() / "plot.png").width(), 500);
}

TEST(Medialab, FloatCostsDigitsWhereItMatters) {
  const json rows = labJson("precision")["rows"];
  bool foundThin = false, foundFar = false;
  for (const json& row : rows) {
    if (row["error_float"].is_null()) {  // no walk in float has the collisions of the one in double
      EXPECT_EQ(row["quantity"], "ratio walk: largest error of the last position, free paths");
      continue;
    }
    const double exact = row["exact"], inFloat = row["error_float"], inDouble = row["error_double"];
    if (row["quantity"] == "1 - exp(-depth)" && row["setting"] == "depth 1e-08") {
      foundThin = true;
      EXPECT_EQ(inFloat, -exact);  // nothing is left of it
      EXPECT_LT(std::abs(inDouble), 1e-7 * exact);
    }
    if (row["setting"] == "depth 1, control x 10000, offset 1e+06") foundFar = true;
  }
  EXPECT_TRUE(foundThin);
  EXPECT_TRUE(foundFar);
}

TEST(Medialab, QuickStressHasNoFailure) {
  const ProcessResult result = lab("stress --quick --quiet --format json");
  EXPECT_EQ(result.status, 0);
  const json document = json::parse(result.output);
  std::map<std::string, int> verdicts;
  for (const json& row : document["rows"]) {
    ++verdicts[row["verdict"]];
    EXPECT_NE(row["verdict"], "fail") << row;
    EXPECT_FALSE(row["verdict"] == "skipped" && row["reason"].get<std::string>().empty()) << row;
  }
  const std::size_t estimators =
      json::parse(lab("list estimators --format json").output)["estimators"].size();
  EXPECT_GT(document["rows"].size(), 20 * estimators);
  EXPECT_GT(verdicts["pass"], static_cast<int>(document["rows"].size()) / 2);
  // Track-length tracking under a low control is what the traits predict cannot work.
  EXPECT_GT(verdicts["expected"], 0);
}

}  // namespace
}  // namespace pbrtmedia
