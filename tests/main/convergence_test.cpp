// SPDX-License-Identifier: BSD-2-Clause
// Error against time, and stops by error, look-ups and time, as a user meets them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/image.h"
#include "support/process.h"
#include "support/source_dir.h"
#include "support/statistics.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

constexpr int kSide = 32;
constexpr double kPixels = kSide * kSide;
/// Every sample of the stripes is 1 with this probability, else 0.
constexpr double kBright = .375, kVariance = kBright * (1 - kBright);

/// A shining stripe in every column of pixels, three eighths as wide; with a medium in front of it, maybe.
std::string stripes(int spp, const std::string& sampler = "random", const std::string& medium = "") {
  std::ostringstream scene;
  scene << "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32 \"string filename\" "
           "\"image.exr\"\nPixelFilter \"box\"\nSampler \""
        << sampler << "\" \"integer pixelsamples\" " << spp
        << "\nIntegrator \"volpath\" \"integer maxdepth\" 0\nLookAt 0 0 -2  0 0 1  0 1 0\n"
           "Camera \"orthographic\"\nWorldBegin\nAttributeBegin\n"
           "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ] \"bool twosided\" \"true\"\n";
  constexpr double kPixel = 2.0 / kSide;
  for (int column = 0; column < kSide; ++column) {
    const double left = -1 + (column + .25) * kPixel, right = left + kBright * kPixel;
    scene << "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ " << left << " -2 2 "
          << right << " -2 2 " << right << " 2 2 " << left << " 2 2 ]\n";
  }
  scene << "AttributeEnd\n";
  if (!medium.empty()) {
    scene << "MakeNamedMedium \"m\" \"rgb sigma_a\" [ 0 0 0 ] \"rgb sigma_s\" [ .5 .5 .5 ] " << medium
          << "\nMaterial \"none\"\nMediumInterface \"m\" \"\"\nShape \"sphere\"\n";
  }
  scene << "WorldEnd\n";
  return scene.str();
}
/// A density that is looked up.
const std::string kGrid =
    "\"string type\" \"heterogeneous\" \"string border\" \"clamp\" \"integer nx\" 1 \"integer ny\" 1 "
    "\"integer "
    "nz\" 2 \"float density\" [ .5 1 ] \"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 1 ] \"string "
    "transmittance\" "
    "\"ratio\"";

class Convergence : public testing::Test {
 protected:
  ProcessResult pbrt(const std::string& arguments, const std::string& before = "") const {
    return run("cd '" + folder_.path().string() + "' && " + before + " '" PBRT_PROGRAM "' --quiet " +
               arguments);
  }
  void writeTruth(float value = kBright) const {
    Image truth(kSide, kSide);
    for (float& v : truth.data()) v = value;
    writeImage(folder_.path() / "truth.exr", truth, {.pixelType = PixelType::Float});
  }
  /// By column; values that are missing or words are not a number.
  std::vector<std::map<std::string, double>> rows(const std::string& name = "c.csv") const {
    std::istringstream in(folder_.read(name));
    std::vector<std::string> names;
    std::vector<std::map<std::string, double>> rows;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with('#')) continue;
      std::vector<std::string> cells(1);
      for (const char c : line) {
        if (c == ',') {
          cells.emplace_back();
        } else {
          cells.back() += c;
        }
      }
      if (names.empty()) {
        names = cells;
        continue;
      }
      EXPECT_EQ(cells.size(), names.size()) << line;
      std::map<std::string, double>& row = rows.emplace_back();
      for (std::size_t i = 0; i < names.size(); ++i) {
        char* end = nullptr;
        const double value = std::strtod(cells[i].c_str(), &end);
        row[names[i]] = end == cells[i].c_str() ? std::nan("") : value;
      }
    }
    return rows;
  }
  nlohmann::json stats() const { return nlohmann::json::parse(folder_.read("s.json"))["renders"][0]; }
  /// Standard deviations by which a mean of squares over the pixels departs from `variance`. Sums of many
  /// samples are nearly normal, so their squares have twice the variance squared.
  static double zOfSquares(double mean, double variance) {
    return (mean - variance) / (variance * std::sqrt(2 / kPixels));
  }
  TemporaryFolder folder_;
};

TEST_F(Convergence, IsThatOfTheClosedForm) {
  folder_.write("a.pbrt", stripes(256));
  writeTruth();
  ASSERT_EQ(pbrt("--reference truth.exr --convergence c.csv a.pbrt").status, 0);
  const auto all = rows();
  ASSERT_GT(all.size(), 10u);
  EXPECT_EQ(all.back().at("spp"), 256);
  double seconds = 0;
  for (const auto& row : all) {
    const double n = row.at("spp");
    EXPECT_GT(row.at("seconds"), seconds);
    seconds = row.at("seconds");
    if (n < 16) continue;  // before sums are nearly normal
    EXPECT_LT(std::abs(zOfSquares(row.at("mse"), kVariance / n)), kMaxAbsZ) << n << " samples";
    EXPECT_NEAR(row.at("rmse"), std::sqrt(row.at("mse")), 1e-8);
    EXPECT_NEAR(row.at("relmse"), row.at("mse") / (kBright * kBright + .01), 1e-6);
    EXPECT_LT(row.at("relmse_robust"), row.at("relmse"));
    EXPECT_LT(std::abs(row.at("mean_signed_difference")) / std::sqrt(kVariance / n / kPixels), kMaxAbsZ);
    EXPECT_NEAR(row.at("time_to_unit_variance"), row.at("mse") * row.at("seconds"), 1e-8);
  }
  // Negative control: against a reference that is 2 % off, the bias is seen.
  writeTruth(static_cast<float>(kBright * 1.02));
  ASSERT_EQ(pbrt("--reference truth.exr --convergence c.csv a.pbrt").status, 0);
  EXPECT_GT(std::abs(rows().back().at("mean_signed_difference")) / std::sqrt(kVariance / 256 / kPixels),
            kMaxAbsZ);
}

TEST_F(Convergence, EndsWithTheNumbersOfImgtoolDiff) {
  folder_.write("a.pbrt", stripes(7));
  writeTruth();
  ASSERT_EQ(pbrt("--pixeltype float --reference truth.exr --convergence c.csv --stats s.json a.pbrt").status,
            0);
  const ProcessResult diff =
      run("cd '" + folder_.path().string() + "' && '" IMGTOOL_PROGRAM "' diff --json image.exr truth.exr");
  const nlohmann::json expected = nlohmann::json::parse(diff.output);
  const auto last = rows().back();
  for (const auto& [column, key] :
       std::map<std::string, std::string>{{"mse", "mse"},
                                          {"rmse", "rmse"},
                                          {"relmse", "relativeMse"},
                                          {"relmse_robust", "relativeMseRobust"},
                                          {"smape", "smape"},
                                          {"mean_signed_difference", "meanSigned"}}) {
    EXPECT_NEAR(last.at(column), expected.at(key).get<double>(), 1e-7) << column;
    EXPECT_NE(last.at(column), 0) << column;
  }
  EXPECT_EQ(last.at("lookups"), stats()["counters"]["densityLookups"]);
  EXPECT_EQ(last.at("rays"),
            stats()["counters"]["rays"].get<double>() + stats()["counters"]["shadowRays"].get<double>());
  EXPECT_GT(stats()["seconds"]["measure"]["wall"], 0);
  EXPECT_LT(last.at("seconds"), stats()["seconds"]["render"]["wall"].get<double>() + 1e-3);
  EXPECT_NE(folder_.read("c.csv").find("# measuring took "), std::string::npos);
}

TEST_F(Convergence, IsEstimatedFromHalvesWithoutAReference) {
  folder_.write("a.pbrt", stripes(128));
  ASSERT_EQ(pbrt("--convergence c.csv a.pbrt").status, 0);
  const auto all = rows();
  EXPECT_TRUE(std::isnan(all.front().at("mse"))) << "one sample has no halves";
  bool isOdd = false;
  for (const auto& row : all) {
    const double n = row.at("spp");
    EXPECT_TRUE(std::isnan(row.at("mean_signed_difference")));
    if (n < 16) continue;
    isOdd |= std::fmod(n, 2) == 1;
    EXPECT_LT(std::abs(zOfSquares(row.at("mse"), kVariance / n)), kMaxAbsZ) << n << " samples";
  }
  EXPECT_TRUE(isOdd) << "halves of unlike size, too";
  EXPECT_NE(folder_.read("c.csv").find(",halves\n"), std::string::npos);
  EXPECT_EQ(folder_.read("c.csv").find(",reference\n"), std::string::npos);
}

TEST_F(Convergence, ChangesNoBitOfTheImage) {
  writeTruth();
  for (const std::string sampler : {"random", "halton", "02sequence"}) {
    folder_.write("a.pbrt", stripes(32, sampler, kGrid + " \"string bounds\" \"progressive\""));
    const auto pixels = [&](const std::string& options) {
      EXPECT_EQ(pbrt("--pixeltype float " + options + " a.pbrt").status, 0) << options;
      return readImage(folder_.path() / "image.exr").data();
    };
    const std::vector<float> plain = pixels("");
    EXPECT_EQ(pixels("--convergence c.csv"), plain);
    EXPECT_EQ(pixels("--convergence c.csv --reference truth.exr"), plain);
    EXPECT_EQ(pixels("--error 1e-9"), plain);
    EXPECT_EQ(pixels("--lookups 1e12 --nthreads 1"), plain);
    EXPECT_NE(pixels("--seed 1"), plain) << "negative control";
  }
}

TEST_F(Convergence, HasTwelveRowsToADecadeOfSeconds) {
  folder_.write("a.pbrt", stripes(100000000));
  writeTruth();
  ASSERT_EQ(pbrt("--time 2 --reference truth.exr --convergence c.csv a.pbrt", "timeout -s KILL 120").status,
            0);
  const auto all = rows();
  const double end = all.back().at("seconds");
  EXPECT_GT(end, 1.5) << "what is rendered takes the time, and measuring comes on top";
  int inLastDecade = 0;
  for (const auto& row : all) inLastDecade += row.at("seconds") > end / 10;
  EXPECT_GE(inLastDecade, 12);
  EXPECT_LE(inLastDecade, 40);
}

TEST_F(Convergence, StopsWhenTheErrorIsSmallEnough) {
  folder_.write("a.pbrt", stripes(1000000));
  const ProcessResult r = pbrt("--strict --error .05 --stats s.json a.pbrt", "timeout -s KILL 120");
  EXPECT_EQ(r.status, 3) << r.output;
  const Image image = readImage(folder_.path() / "image.exr");
  EXPECT_EQ(image.metadata.at("stoppedBy"), "error");
  EXPECT_EQ(stats()["stoppedBy"], "error");
  EXPECT_TRUE(stats()["interrupted"].get<bool>());
  // relmse = variance / n / (truth² + .01); looks are a tenth apart, estimates a twentieth off.
  const double wanted = kVariance / (kBright * kBright + .01) / (.05 * .05),
               taken = stats()["samplesTaken"].get<double>() / kPixels;
  EXPECT_GT(taken, .8 * wanted);
  EXPECT_LT(taken, 1.4 * wanted);
  // What reaches its end is not stopped early.
  EXPECT_EQ(pbrt("--strict --error 1e-9 --spp 4 --stats s.json a.pbrt").status, 0);
  EXPECT_EQ(stats()["stoppedBy"], "");
  EXPECT_FALSE(readImage(folder_.path() / "image.exr").metadata.contains("stoppedBy"));
}

TEST_F(Convergence, StopsWithinOneSampleOfABudgetOfLookups) {
  folder_.write("a.pbrt", stripes(1000000, "random", kGrid));
  ASSERT_EQ(pbrt("--spp 16 --stats s.json a.pbrt").status, 0);
  const double perIndex = stats()["counters"]["densityLookups"].get<double>() / 16;
  ASSERT_GT(perIndex, 100);
  for (const double budget : {3.3, 25.0, 200.5}) {
    const auto lookups = static_cast<long>(budget * perIndex);
    const ProcessResult r = pbrt("--strict --lookups " + std::to_string(lookups) + " --stats s.json a.pbrt",
                                 "timeout -s KILL 120");
    EXPECT_EQ(r.status, 3) << r.output;
    EXPECT_EQ(stats()["stoppedBy"], "lookups");
    EXPECT_GE(stats()["counters"]["densityLookups"], lookups);
    EXPECT_LT(stats()["counters"]["densityLookups"].get<double>(),
              static_cast<double>(lookups) + 1.5 * perIndex);
  }
}

TEST_F(Convergence, TakesASampleOfEachPixelWhenAWarmUpHasTakenAllLookups) {
  folder_.write("a.pbrt", stripes(100, "random", kGrid + " \"string bounds\" \"progressive\""));
  const ProcessResult r = pbrt("--lookups 1 --stats s.json a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_EQ(stats()["stoppedBy"], "lookups");
  EXPECT_EQ(100 * stats()["samplesTaken"].get<int>(), stats()["samplesPlanned"].get<int>());
}

TEST_F(Convergence, TakesNoBlackImageForAGoodOne) {
  folder_.write("dot.pbrt",
                "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 \"string filename\" "
                "\"dot.pfm\"\nSampler \"random\" \"integer pixelsamples\" 1000\nIntegrator \"path\"\n"
                "Camera \"perspective\" \"float fov\" 42\nWorldBegin\n"
                "AreaLightSource \"diffuse\" \"rgb L\" [ 100 100 100 ]\nTranslate 0 0 5\n"
                "Shape \"sphere\" \"float radius\" .02\nWorldEnd\n");
  ASSERT_EQ(pbrt("--error .5 --stats s.json dot.pbrt").status, 0);
  EXPECT_EQ(stats()["stoppedBy"], "error") << "negative control";
  EXPECT_GT(stats()["samplesTaken"].get<int>(), 2 * 18 * 18);
}

TEST_F(Convergence, TellsWhatStoppedARenderEarly) {
  folder_.write("a.pbrt", stripes(100000000));
  EXPECT_EQ(pbrt("--strict --time 1 --stats s.json a.pbrt", "timeout -s KILL 120").status, 3);
  EXPECT_EQ(stats()["stoppedBy"], "time");
  EXPECT_EQ(pbrt("--time 1 a.pbrt", "timeout -s KILL 120").status, 0) << "only --strict minds";
  EXPECT_EQ(pbrt("--strict --stats s.json a.pbrt", "timeout --preserve-status -s INT 1").status, 3);
  EXPECT_EQ(stats()["stoppedBy"], "signal");
}

TEST_F(Convergence, RefusesWhatCannotBeMeasuredAgainst) {
  folder_.write("a.pbrt", stripes(4));
  const auto refused = [&](const std::string& options, const std::string& why) {
    const ProcessResult r = pbrt(options + " a.pbrt");
    EXPECT_EQ(r.status, 1) << options;
    EXPECT_NE(r.output.find(why), std::string::npos) << r.output;
  };
  refused("--reference none.exr --convergence c.csv", "none.exr");
  refused("--reference none.exr", "--convergence");
  refused("--convergence nowhere/c.csv", "--convergence \"nowhere/c.csv\": cannot be written");
  writeImage(folder_.path() / "small.exr", Image(8, 8), {});
  refused("--reference small.exr --convergence c.csv",
          "--reference: it is a picture of 8 x 8 pixels; this one has 32 x 32");
  Image bad(kSide, kSide);
  bad.at(3, 4, 1) = std::numeric_limits<float>::infinity();
  writeImage(folder_.path() / "bad.exr", bad, {});
  refused("--reference bad.exr --convergence c.csv", "no finite numbers");
  for (const char* value : {"0", "-1", "nan", "x"}) {
    refused(std::string("--error ") + value, "--error");
    refused(std::string("--lookups ") + value, "--lookups");
  }
  folder_.write("two.pbrt", stripes(4) + stripes(4));
  const ProcessResult r = pbrt("--convergence c.csv two.pbrt");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("there are 2 WorldBegin"), std::string::npos) << r.output;
}

TEST_F(Convergence, MeasuresACropAgainstTheWholeOrTheCrop) {
  folder_.write("a.pbrt", stripes(4));
  ASSERT_EQ(pbrt("--spp 64 --pixeltype float --outfile whole.exr a.pbrt").status, 0);
  ASSERT_EQ(pbrt("--spp 64 --pixeltype float --outfile part.pfm --cropwindow .25 .5 .5 1 a.pbrt").status, 0);
  std::vector<double> errors;
  for (const std::string reference : {"whole.exr", "part.pfm"}) {
    ASSERT_EQ(
        pbrt("--seed 1 --cropwindow .25 .5 .5 1 --convergence c.csv --reference " + reference + " a.pbrt")
            .status,
        0);
    errors.push_back(rows().back().at("mse"));
  }
  EXPECT_GT(errors[0], 0);
  EXPECT_EQ(errors[0], errors[1]) << "the samples of a crop are those of the whole";
  EXPECT_EQ(pbrt("--convergence c.csv --reference part.pfm a.pbrt").status, 1);
}

TEST_F(Convergence, HasColumnsAsTheDocumentationSays) {
  folder_.write("a.pbrt", stripes(1));
  ASSERT_EQ(pbrt("--convergence c.csv a.pbrt").status, 0);
  std::string page;
  std::getline(std::ifstream(sourceDir() / "docs" / "convergence.md"), page, '\0');
  std::istringstream in(folder_.read("c.csv"));
  std::string names;
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("# ") || line.starts_with("# conv") || line.starts_with("# meas")) continue;
    std::string definition;
    for (const char c : line.substr(colon + 2)) {
      if (c == '|') definition += '\\';
      definition += c;
    }
    std::string row = "| `";
    row.append(line.substr(2, colon - 2)).append("` | ").append(definition).append(" |");
    EXPECT_NE(page.find(row), std::string::npos) << row;
    if (!names.empty()) names += ',';
    names += line.substr(2, colon - 2);
  }
  names.insert(0, 1, '\n').append(1, '\n');
  EXPECT_NE(folder_.read("c.csv").find(names), std::string::npos) << names;
}

}  // namespace
}  // namespace pbrtmedia::test
