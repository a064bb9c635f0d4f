// SPDX-License-Identifier: BSD-2-Clause
// Transmittance estimators times fields: what an estimate and a look-up cost, and what they are worth.
// Usage: estimator_bench [--json FILE] [--field NAME] [estimator]...   (default: all)
//
// Each row walks the same random lines through the unit cube, scaled to optical depth 2 on average. The truth
// of a line is the law of the estimator at its exact optical depth (regular tracking). The mean of every
// estimator that promises no bias and a finite variance is checked against it; one that fails ends the
// program with an error after the last row. `variance` is that within a line. `mse` is the mean
// squared error: of unbiased rows the variance again, of others the bias too; efficiency is 1 / (mse x
// seconds). "unreliable" marks trials too short for the timer.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rng.h"
#include "base/warp.h"
#include "fields/constant_field.h"
#include "fields/field_line.h"
#include "fields/grid_field.h"
#include "measure.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia::bench {
namespace {

constexpr std::uint64_t kSeed = 3;
constexpr std::size_t kLines = 256;
constexpr std::size_t kTrials = 11;
constexpr std::size_t kRepeats = 64;      ///< estimates per line for mean and error
constexpr double kMeanDepth = 2;          ///< optical depth of the lines on average
constexpr double kMaxAbsZ = 5;            ///< as in the tests
constexpr double kShortestTrial = 20e-6;  ///< seconds; below, the timer's resolution shows
constexpr int kPasses = 8;                ///< over the lines, per trial
constexpr double kExact = 1e-14;          ///< an mse below is rounding, no error to compare
constexpr int kSuperVoxelPower = 2;

/// Sums of random waves, floored at 0 or not: `waves` per axis at most.
GridField::Params wavyGrid(int n, int waves, float floor) {
  GridField::Params params{n, n, n, {}, {0, 0, 0}, {1, 1, 1}, GridBorder::Clamp};
  Rng rng(kSeed);
  constexpr int kTerms = 8;
  Vec3d frequency[kTerms];
  double phase[kTerms];
  for (int i = 0; i < kTerms; ++i) {
    for (std::size_t a = 0; a < 3; ++a) frequency[i][a] = waves * (2 * rng.uniformDouble() - 1) * 6.2832 / n;
    phase[i] = 6.2832 * rng.uniformDouble();
  }
  params.density.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) *
                         static_cast<std::size_t>(n));
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        double sum = 0;
        for (int i = 0; i < kTerms; ++i) {
          sum += std::cos(frequency[i].x * x + frequency[i].y * y + frequency[i].z * z + phase[i]);
        }
        params.density.push_back(std::max(0.0f, floor + static_cast<float>(sum / kTerms)));
      }
    }
  }
  return params;
}

/// Every sample by itself: nothing that a comb could integrate well.
GridField::Params roughGrid(int n) {
  GridField::Params params{n, n, n, {}, {0, 0, 0}, {1, 1, 1}, GridBorder::Zero};
  Rng rng(kSeed);
  params.density.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) *
                        static_cast<std::size_t>(n));
  for (float& v : params.density) v = rng.uniform() < .5f ? 0 : rng.uniform();
  return params;
}

template <class Field>
struct Scene {
  const Field& field;
  FieldBounds bounds;
  std::vector<FieldLine<Field>> lines{};
  std::vector<double> columns{};  ///< integral of the density
  Channels<1> sigmaT{1};
};

template <class Field>
Scene<Field> sceneOf(const Field& field, SuperVoxels bounds) {
  Scene<Field> scene{field, FieldBounds::proven(std::move(bounds))};
  Rng rng(kSeed + 1);
  double sum = 0;
  while (scene.lines.size() < kLines) {
    const Point3f through(rng.uniform(), rng.uniform(), rng.uniform());
    const Vector3f d = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const auto line = FieldLine<Field>::clip(field, scene.bounds, {through - 2.0f * d, d, 0, kInfinity});
    if (!line) continue;
    LookupTally unused;
    scene.lines.push_back(*line);
    scene.columns.push_back(RegularTracking::densityIntegral(*line, 1e300, unused));
    sum += scene.columns.back();
  }
  scene.sigmaT = {kMeanDepth * static_cast<double>(kLines) / sum};
  return scene;
}

struct Row {
  Trials ns;
  double lookups = 0, variance = 0, mse = 0, bias = 0, z = 0;
  bool checked = false, reliable = true;
  bool passed() const { return !checked || std::abs(z) < kMaxAbsZ; }
};

template <class Field>
Row measure(const Scene<Field>& scene, const AnyEstimator& any) {
  Row row;
  const EstimatorTraits traits = traitsOf(any);
  const AnyLaw law = lawOf(any);
  visitEstimator(
      [&](const auto& estimator) {
        // Mean and error: the mean over all lines has the variance of the errors within each line.
        Rng rng(kSeed + 2);
        double error = 0, squares = 0, variance = 0, lookups = 0, largest = 0;
        for (std::size_t i = 0; i < kLines; ++i) {
          const double truth = transmittanceOf(law, scene.sigmaT[0] * scene.columns[i]);
          double sum = 0, sumSquares = 0;
          for (std::size_t n = 0; n < kRepeats; ++n) {
            SampleStream stream(rng);
            const Estimate<1> estimate = estimator(scene.lines[i], scene.sigmaT, stream);
            const double e = estimate.value[0] - truth;
            sum += e;
            sumSquares += e * e;
            largest = std::max(largest, std::abs(e));
            lookups += static_cast<double>(estimate.tally.lookups);
          }
          error += sum;
          squares += sumSquares;
          variance += sumSquares - sum * sum / kRepeats;
        }
        constexpr double kCount = static_cast<double>(kLines * kRepeats);
        row.lookups = lookups / kCount;
        row.variance = variance / (kRepeats - 1) / static_cast<double>(kLines);
        row.mse = squares / kCount;
        row.bias = error / kCount;
        // Samples of a float field: the truth itself is good to a few 1e-7.
        constexpr double kTruthError = 1e-6;
        const double standardError = std::sqrt(row.variance / kCount);
        row.z = std::max(0.0, std::abs(row.bias) - kTruthError) / std::max(standardError, 1e-300);
        row.checked = traits.bias == EstimatorTraits::Bias::Unbiased && traits.finiteVariance;

        for (std::size_t trial = 0; trial <= kTrials; ++trial) {
          Rng trialRng(kSeed + 3 + trial);
          const double start = threadSeconds();
          for (int pass = 0; pass < kPasses; ++pass) {
            for (const auto& line : scene.lines) {
              SampleStream stream(trialRng);
              keep(estimator(line, scene.sigmaT, stream).value[0]);
            }
          }
          const double seconds = threadSeconds() - start;
          if (trial == 0) continue;  // warm-up
          row.reliable = row.reliable && seconds > kShortestTrial;
          row.ns.add(seconds / static_cast<double>(kPasses * kLines) * 1e9);
        }
      },
      any);
  return row;
}

struct Options {
  const char* json = nullptr;
  std::string_view field;
  std::vector<std::string_view> estimators;
};

template <class Field>
bool walk(std::string_view name, const Field& field, SuperVoxels bounds, const Options& options,
          nlohmann::json& rows) {
  if (!options.field.empty() && options.field != name) return true;
  const Scene<Field> scene = sceneOf(field, std::move(bounds));
  bool good = true;
  std::printf("%.*s\n%-28s %10s %7s %9s %10s %11s %11s %11s\n", static_cast<int>(name.size()), name.data(),
              "estimator", "ns", "spread", "look-ups", "ns/look-up", "variance", "mse", "1/(mse s)");
  for (const std::string_view estimatorName : options.estimators) {
    const Row row = measure(scene, *findEstimator(estimatorName));
    const double ns = row.ns.median(), efficiency = 1 / (row.mse * ns * 1e-9);
    const bool exact = row.mse < kExact;
    char perLookup[32] = "-", worth[32] = "exact";
    if (row.lookups > 0) std::snprintf(perLookup, sizeof perLookup, "%.1f", ns / row.lookups);
    if (!exact) std::snprintf(worth, sizeof worth, "%.3g", efficiency);
    std::printf("%-28.*s %10.1f %7.2f %9.2f %10s %11.3g %11.3g %11s%s%s\n",
                static_cast<int>(estimatorName.size()), estimatorName.data(), ns, row.ns.spread(),
                row.lookups, perLookup, row.variance, row.mse, worth, row.reliable ? "" : "  unreliable",
                row.passed() ? "" : "  THE MEAN IS WRONG");
    std::fflush(stdout);
    // An exact row has no efficiency, and one without look-ups no price per look-up.
    rows.push_back({{"field", name},
                    {"estimator", estimatorName},
                    {"nsPerEstimate", ns},
                    {"spread", row.ns.spread()},
                    {"lookups", row.lookups},
                    {"nsPerLookup", row.lookups > 0 ? nlohmann::json(ns / row.lookups) : nlohmann::json()},
                    {"variance", row.variance},
                    {"mse", row.mse},
                    {"bias", row.bias},
                    {"efficiency", exact ? nlohmann::json() : nlohmann::json(efficiency)},
                    {"meanChecked", row.checked},
                    {"z", row.z},
                    {"reliable", row.reliable}});
    good = good && row.passed();
  }
  return good;
}

int run(int argc, char** argv) {
  constexpr std::string_view kFields[] = {"constant", "grid-40-smooth", "grid-40-rough", "grid-256"};
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--json" && i + 1 < argc) {
      options.json = argv[++i];
    } else if (word == "--field" && i + 1 < argc) {
      options.field = argv[++i];
      if (std::find(std::begin(kFields), std::end(kFields), options.field) == std::end(kFields)) {
        std::fprintf(
            stderr, "error: unknown field \"%s\"; known: constant, grid-40-smooth, grid-40-rough, grid-256\n",
            argv[i]);
        return EXIT_FAILURE;
      }
    } else if (findEstimator(word)) {
      options.estimators.push_back(word);
    } else {
      std::string known;
      for (const std::string_view name : estimatorNames())
        known.append(known.empty() ? "" : ", ").append(name);
      std::fprintf(stderr, "error: unknown estimator \"%s\"; known: %s\n", argv[i], known.c_str());
      return EXIT_FAILURE;
    }
  }
  if (options.estimators.empty()) options.estimators = estimatorNames();

  nlohmann::json report = {{"environment", environment()},
                           {"lines", kLines},
                           {"trials", kTrials},
                           {"meanOpticalDepth", kMeanDepth},
                           {"superVoxelPower", kSuperVoxelPower}};
  nlohmann::json& rows = report["rows"] = nlohmann::json::array();
  std::printf("%s\n", report["environment"].dump().c_str());
  bool good = true;
  const ConstantField constant({}, Transform());
  good &= walk("constant", constant, constant.superVoxels(), options, rows);
  const auto grid = [&](std::string_view name, auto&& params) {
    if (!options.field.empty() && options.field != name) return;
    const GridField field(params(), Transform());
    good &= walk(name, field, field.superVoxels(kSuperVoxelPower), options, rows);
  };
  grid("grid-40-smooth", [] { return wavyGrid(40, 3, .6f); });
  grid("grid-40-rough", [] { return roughGrid(40); });
  grid("grid-256", [] { return wavyGrid(256, 12, .1f); });
  if (options.json) writeJson(report, options.json);
  if (!good) std::fprintf(stderr, "error: a mean is wrong\n");
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace pbrtmedia::bench

int main(int argc, char** argv) { return pbrtmedia::bench::run(argc, argv); }
