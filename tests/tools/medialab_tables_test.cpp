// SPDX-License-Identifier: BSD-2-Clause
// Densities that come from files: tables, and lines through volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "support/temporary_folder.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/tabulated.h"
#include "tools/medialab/trials.h"
#include "tools/medialab/volume_line.h"
#ifdef PBRT_MEDIA_HAS_NANOVDB
#include "fields/nano_vdb_samples.h"
#endif

namespace pbrtmedia {
namespace {

class MedialabTable : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    const std::filesystem::path path = folder_.path() / "density.csv";
    std::ofstream(path) << text;
    return path;
  }
  std::string problemOf(const std::string& text) {
    try {
      readTabulatedFunction(write(text));
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "none";
  }
  TemporaryFolder folder_;
};

TEST_F(MedialabTable, IsStraightBetweenPointsAndJumpsAtEqualOnes) {
  const CanonicalFunction f =
      readTabulatedFunction(write("x,density\n# a jump at 3\n2,0\n3,4\r\n3 1\n\n5\t1\n"));
  EXPECT_EQ(f.width(), 3);  // from 2 to 5
  EXPECT_DOUBLE_EQ(f(0.25), 1);
  EXPECT_EQ(f(1), 1);
  EXPECT_EQ(f(2.5), 1);
  EXPECT_DOUBLE_EQ(f.integral(), 0.5 * 4 + 2);
  EXPECT_DOUBLE_EQ(f.integral(0.5, 1.5), (2 + 4) / 2. * 0.5 + 0.5);
  EXPECT_EQ(f.range().max, 4);
  EXPECT_EQ(f.range(1, 2).max, 4) << "both values of a jump";
  EXPECT_TRUE(f.isPiecewisePolynomial());
}

TEST_F(MedialabTable, HasTheIntegralOfAnIndependentSum) {
  std::string text;
  double sum = 0, before = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double value = 1 + std::sin(i * i * 0.01);
    text += std::to_string(i * 0.125) + "," + std::to_string(value) + "\n";
    const double read = std::stod(std::to_string(value));
    if (i > 0) sum += (before + read) / 2 * 0.125;
    before = read;
  }
  EXPECT_NEAR(readTabulatedFunction(write(text)).integral(), sum, 1e-12 * sum);
}

TEST_F(MedialabTable, ProblemsNameTheirLine) {
  const std::string file = (folder_.path() / "density.csv").string();
  EXPECT_EQ(problemOf("0,1\n1,-2\n"), file + ":2: found density -2, expected a finite number, at least 0");
  EXPECT_EQ(problemOf("0,1\n1,nan\n"), file + ":2: found density nan, expected a finite number, at least 0");
  EXPECT_EQ(problemOf("x,y\nx,y\n"), file + ":2: found \"x,y\", expected two numbers: x,density");
  EXPECT_EQ(problemOf("0,1\n1,2,3\n"), file + ":2: found \"1,2,3\", expected two numbers: x,density");
  EXPECT_EQ(problemOf("0,1\n2,1\n1,1\n"), file + ":3: x goes back from 2 to 1");
  EXPECT_EQ(problemOf("0,1\n"), file + ":1: found 1 points, expected two at least");
  EXPECT_EQ(problemOf("0,1\n0,2\n"), file + ":2: all points have the same x");
  EXPECT_EQ(problemOf("0,0\n1,0\n"), file + ":2: all densities are 0");
  EXPECT_THROW(readTabulatedFunction(folder_.path() / "absent.csv"), std::runtime_error);
}

TEST_F(MedialabTable, EstimatorsAgreeWithItsTransmittance) {
  const std::string word = write("0,0\n1,3\n2,0.5\n4,0.5\n").string();
  const CanonicalFunction f = FunctionSelection{.words = {word}, .ray = {}, .grid = {}}.select().front();
  EXPECT_EQ(f.about().name, word);
  const LabProblem problem{CanonicalLine(f, {.length = f.width()}), 1};
  EXPECT_DOUBLE_EQ(problem.depth(), 1.5 + 1.75 + 1);
  // Ratio tracking under the exact bound: E = exp(-4.25), and regular tracking finds it by the pieces.
  std::vector<LabTable::Skipped> skipped;
  for (const LabEstimator& estimator :
       EstimatorSelection{.estimators = {"ratio", "regular"}, .law = {}, .params = {}}.select(skipped)) {
    const TrialStats stats = runTrials(estimator, problem, {}, 7, {.trials = 20000, .lookups = ~0ull});
    EXPECT_NEAR(stats.value.mean(), std::exp(-4.25), 5 * stats.value.meanError() + 1e-12)
        << estimator.label();
  }
}

TEST(MedialabVolume, RayBelongsToVolumesAlone) {
  EXPECT_THROW((FunctionSelection{.words = {"cosine"}, .ray = {0, 0, 0, 1, 0, 0}, .grid = {}}.select()),
               std::runtime_error);
  EXPECT_THROW((FunctionSelection{.words = {"smoke.nvdb"}, .ray = {0, 0, 0}, .grid = {}}.select()),
               std::runtime_error);
}

#ifdef PBRT_MEDIA_HAS_NANOVDB

double hashed(test::Ijk p) { return 0.5 + 0.5 * std::sin(12.9898 * p[0] + 78.233 * p[1] + 37.719 * p[2]); }

TEST(MedialabVolume, IsTheTrilinearDensityAlongTheRay) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "smoke.nvdb";
  const double voxel = 0.25;
  test::writeNanoVdb(
      file, {{.max = {11, 9, 10}, .valueAt = hashed, .worldFromIndex = Transform::scale(0.25, 0.25, 0.25)}});
  const Vec3d o{-3, 0.31, 0.4}, d{1, 0.23, 0.31};
  const CanonicalFunction f = functionAlong(file, "", {.o = o, .d = 2.0 * d});
  const Vec3d unit = d / std::sqrt(dot(d, d));
  // It enters where an active voxel begins to reach: at x = -1 voxel.
  const double entry = (-voxel - o.x) / unit.x;
  std::vector<Vec3d> points;
  std::vector<double> x;
  for (int i = 1; i < 400; ++i) {
    x.push_back(f.width() * i / 400.);
    points.push_back(o + (entry + x.back()) * unit);
  }
  const std::vector<double> expected = test::sampledByNanoVdb(file, 0, points);
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(f(x[i]), expected[i], 2e-6) << x[i];
    largest = std::max(largest, expected[i]);
  }
  EXPECT_GT(largest, 0.5);
  // The integral against a fine sum of the library's own samples: second order, 1e5 points.
  const int n = 100000;
  std::vector<Vec3d> fine;
  for (int i = 0; i < n; ++i) fine.push_back(o + (entry + f.width() * (i + 0.5) / n) * unit);
  double sum = 0;
  for (const double v : test::sampledByNanoVdb(file, 0, fine)) sum += v * f.width() / n;
  EXPECT_NEAR(f.integral(), sum, 2e-6 * sum);
  EXPECT_GE(f.range().max, largest * (1 - 1e-5));
  EXPECT_TRUE(f.isPiecewisePolynomial());
}

TEST(MedialabVolume, ARayThatMissesIsAnError) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "smoke.nvdb";
  test::writeNanoVdb(file, {{.max = {3, 3, 3}, .valueAt = hashed}});
  EXPECT_THROW(functionAlong(file, "", {.o = {0, 50, 0}, .d = {1, 0, 0}}), std::runtime_error);
  EXPECT_THROW(functionAlong(file, "", {.o = {9, 1, 1}, .d = {1, 0, 0}}), std::runtime_error) << "behind";
  EXPECT_THROW(functionAlong(file, "", {.o = {0, 1, 1}, .d = {0, 0, 0}}), std::runtime_error);
  EXPECT_THROW(functionAlong(file, "temperature", {.o = {-9, 1, 1}, .d = {1, 0, 0}}), std::runtime_error);
}

#endif

}  // namespace
}  // namespace pbrtmedia
