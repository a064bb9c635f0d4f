// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/heatmap.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/diagnostics.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/writable.h"
#include "image/image.h"
#include "tools/medialab/heatmap_picture.h"
#include "tools/medialab/journal.h"

namespace pbrtmedia {
namespace {

using Measure = Heatmap::Measure;

/// Trials per look-up of the budget at most, for estimates that look nowhere.
constexpr std::uint64_t kTrialsPerLookup = 4;
constexpr double kRoundingOfMeans = 1e-9;

/// The densities of a map: one for all columns, or a family with one for each.
class Columns {
 public:
  Columns(const HeatmapOptions& o) : o_(o) {
    if (o.family.empty()) {
      functions_ = {o.function.select().front()};
      return;
    }
    for (int x = 0; x < o.width; ++x) {
      auto member = findDensityFamily(o.family, HeatmapAxis{0, 1}.at(x, o.width));
      if (!member) {
        throw std::runtime_error("unknown family \"" + o.family + '"' +
                                 suggestion(o.family, densityFamilyNames()));
      }
      functions_.push_back(*std::move(member));
      most_ = std::max(most_, functions_.back().range().max);
    }
  }
  const CanonicalFunction& at(int x) const {
    return functions_[functions_.size() > 1 ? static_cast<std::size_t>(x) : 0];
  }
  /// The problem of a pixel, but for what they all have in common.
  ProblemOptions problem(const Heatmap& map, const LabEstimator& estimator, int x, int y) const {
    ProblemOptions at = o_.problem;
    if (!map.family.empty()) {
      at.depths = {map.row(y)};
      if (o_.isControlShared) at.controls.front() *= most_ / this->at(x).range().max;
      return at;
    }
    at.depths = {depthOfAnswer(estimator, map.column(x))};
    (o_.rows == HeatmapRows::Efficiency ? at.efficiencies : at.controls) = {map.row(y)};
    return at;
  }

 private:
  const HeatmapOptions& o_;
  std::vector<CanonicalFunction> functions_;
  double most_ = 0;  ///< largest density of all
};

Heatmap::Pixel measurePixel(const HeatmapOptions& o, const CanonicalFunction& function,
                            const LabEstimator& estimator, const ProblemOptions& at, std::uint64_t index,
                            TrialJournal& journal, const StopSignal& stop) {
  const ProblemChoice choice = problemChoices(at, function).front();
  const LabProblem problem = makeProblem(at, function, choice);
  TrialLimit limit{.trials = o.trials};
  if (o.trials == 0) limit = {.trials = kTrialsPerLookup * o.lookups, .lookups = o.lookups};
  std::uint64_t seed = rowSeed(o.lab.seed, estimator.label(), function.about().name, choice);
  if (!o.family.empty()) seed = hashCombine(seed, index);  // members differ in more than their name
  const TrialStats stats =
      journal.recall(seed, stop.flag(), [&] { return runTrials(estimator, problem, o.plan, seed, limit); });
  Heatmap::Pixel pixel;
  pixel.exact = problem.exact(estimator);
  pixel.mean = stats.value.mean();
  pixel.meanError = stats.value.meanError();
  pixel.variance = stats.value.variance();
  pixel.lookups = stats.lookupsPerTrial();
  pixel.seconds = stats.secondsPerTrial();
  pixel.trials = stats.trials();
  pixel.nonFinite = stats.nonFinite;
  return pixel;
}

std::string rowsName(HeatmapRows rows) {
  return rows == HeatmapRows::Efficiency ? "efficiency" : rows == HeatmapRows::Control ? "control" : "depth";
}
/// What rows run over unless a range is given.
HeatmapAxis rowsOf(const HeatmapOptions& o, const CanonicalFunction& function) {
  if (!o.family.empty()) return {0, 9.9};
  return o.rows == HeatmapRows::Efficiency ? HeatmapAxis{0.01, function.about().topEfficiency}
                                           : HeatmapAxis{1, 2};
}

LabTable tableOf(const HeatmapOptions& o, const std::string& function, const Heatmap& map) {
  std::vector<std::string> columns{"estimator", "extinction", "x", "y"};
  columns.insert(columns.end(),
                 {map.family.empty() ? std::string(nameOf(map.quantity)) : map.family, rowsName(map.rows),
                  "trials", "exact", "mean", "mean_stderr", "variance", "lookups"});
  if (!o.lab.omitSeconds) columns.emplace_back("seconds_per_estimate");
  columns.emplace_back("inverse_efficiency_lookups");
  if (!o.lab.omitSeconds) columns.emplace_back("inverse_efficiency_seconds");
  columns.insert(columns.end(), {"non_finite", "best_variance", "best_inverse_efficiency"});
  LabTable table(o.lab.command, columns);
  for (std::size_t l = 0; l < map.layers.size(); ++l) {
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const std::size_t i = map.index(x, y);
        const Heatmap::Pixel& p = map.layers[l].pixels[i];
        if (p.trials == 0) continue;
        std::vector<LabTable::Cell> row{map.layers[l].estimator,
                                        function,
                                        static_cast<std::uint64_t>(x),
                                        static_cast<std::uint64_t>(y),
                                        map.column(x),
                                        map.row(y),
                                        p.trials,
                                        p.exact,
                                        p.mean,
                                        p.meanError,
                                        p.variance,
                                        p.lookups};
        if (!o.lab.omitSeconds) row.emplace_back(p.seconds);
        row.emplace_back(p.value(Measure::VarianceLookups));
        if (!o.lab.omitSeconds) row.emplace_back(p.value(Measure::VarianceSeconds));
        row.emplace_back(p.nonFinite);
        row.emplace_back(map.best(i, Measure::Variance) == l);
        row.emplace_back(map.best(i, Measure::VarianceLookups) == l);
        table.add(std::move(row));
      }
    }
  }
  return table;
}

const std::string& nameOfDensity(const HeatmapOptions& o) {
  return o.family.empty() ? o.function.words.front() : o.family;
}

/// "share of pixels where each estimator is best" as notes.
void noteShares(LabTable& table, const Heatmap& map) {
  for (const auto& [measure, name] :
       {std::pair{Measure::Variance, "variance"}, {Measure::VarianceLookups, "variance x lookups"}}) {
    std::vector<std::size_t> counts(map.layers.size());
    std::size_t total = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
         ++i) {
      const std::size_t best = map.best(i, measure);
      if (best == Heatmap::kNoBest) continue;
      ++counts[best];
      ++total;
    }
    std::string text = "lowest ";
    text += name;
    text += ", percent of the pixels:";
    for (std::size_t l = 0; l < counts.size(); ++l) {
      if (counts[l] == 0) continue;
      const double percent = 100.0 * static_cast<double>(counts[l]) / static_cast<double>(total);
      text += ' ' + map.layers[l].estimator + ' ' + formatNumber(std::round(10 * percent) / 10);
    }
    table.note(text);
  }
}

/// The estimators of a map, all under one law: a best one among values of different laws would mean nothing.
/// "all" stands for those of the exponential law unless another is named.
std::vector<LabEstimator> estimatorsOf(const HeatmapOptions& o, std::vector<LabTable::Skipped>& skipped) {
  EstimatorSelection selection = o.selection;
  const bool isTransmittance =
      selection.quantity.value_or(Quantity::Transmittance) == Quantity::Transmittance;
  if (selection.isAll() && selection.law.empty() && isTransmittance) selection.law = "exponential";
  std::vector<LabEstimator> estimators = selection.select(skipped);
  for (const LabEstimator& one : estimators) {
    const std::string first = describeQuantity(estimators.front()), law = describeQuantity(one);
    if (law == first) continue;
    std::string text = "a map compares estimators of one law: " + estimators.front().label() + " serves ";
    text += first;
    text += ", " + one.label() + ' ';
    text += law;
    throw std::runtime_error(text);
  }
  return estimators;
}

/// Throws unless some finite depth has the answer.
void checkAnswer(const LabEstimator& estimator, double answer) {
  const bool isTransmittance = estimator.quantity() == Quantity::Transmittance;
  if (!(answer > 0) || !std::isfinite(answer) || (isTransmittance && answer > 1)) {
    throw std::runtime_error("--range: expected two numbers above 0" +
                             std::string(isTransmittance ? " and up to 1" : "") + ", found " +
                             formatNumber(answer));
  }
  if (std::isfinite(depthOfAnswer(estimator, answer))) return;
  throw std::runtime_error("the law " + describeQuantity(estimator) + " never falls to the transmittance " +
                           formatNumber(answer));
}

}  // namespace

double Heatmap::Pixel::value(Measure measure) const {
  if (nonFinite > 0) return kUnknown;
  switch (measure) {
    case Measure::Variance:
      return variance;
    case Measure::VarianceLookups:
      return variance * lookups;
    case Measure::VarianceSeconds:
      return variance * seconds;
  }
  return kUnknown;
}

std::size_t Heatmap::best(std::size_t pixel, Measure measure) const {
  std::size_t best = kNoBest;
  double least = 0, leastLookups = 0;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const Pixel& p = layers[l].pixels[pixel];
    double value = p.value(measure);
    if (!std::isfinite(value)) continue;
    if (!layers[l].isUnbiased) continue;
    const double rounding = kRoundingOfMeans * p.exact;
    if (p.variance <= rounding * rounding) {
      if (std::abs(p.mean - p.exact) > kRoundingOfMeans * p.exact) continue;
      value = 0;
    }
    if (best != kNoBest && (value > least || (value == least && p.lookups >= leastLookups))) continue;
    best = l;
    least = value;
    leastLookups = p.lookups;
  }
  return best;
}

Heatmap measureHeatmap(const HeatmapOptions& o, std::vector<LabTable::Skipped>& skipped,
                       const StopSignal& stop) {
  o.problem.check();
  if (o.width < 1 || o.height < 1) throw std::runtime_error("--resolution: expected at least 1 x 1");
  if (o.trials == 0 && o.lookups < 1) throw std::runtime_error("--lookups: expected at least 1");
  if (o.trials == 1) throw std::runtime_error("--trials: expected at least 2, for a variance");
  const Columns columns(o);
  Heatmap map{.width = o.width,
              .height = o.height,
              .answers = o.answers,
              .rows = o.family.empty() ? o.rows : HeatmapRows::Depth,
              .rowRange = o.rowRange.value_or(rowsOf(o, columns.at(0))),
              .family = o.family};
  const std::vector<LabEstimator> estimators = estimatorsOf(o, skipped);
  if (!estimators.empty()) {
    map.quantity = estimators.front().quantity();
    map.law = describeQuantity(estimators.front());
    if (o.family.empty()) {
      for (const double answer : {o.answers.first, o.answers.last}) checkAnswer(estimators.front(), answer);
    }
  }
  TrialJournal journal(o.lab.resume, o.lab.identity);
  LabProgress progress("medialab heatmap", estimators.size() * static_cast<std::size_t>(o.height),
                       o.lab.quiet);
  for (const LabEstimator& estimator : estimators) {
    const LabProblem any = makeProblem(o.problem, columns.at(0), {1, 1, 0});
    if (const std::string why = whyNotApplicable(estimator, any.line); !why.empty()) {
      skipped.push_back({estimator.label(), why});
      continue;
    }
    Heatmap::Layer layer{estimator.label(), {}};
    layer.isUnbiased = estimator.bias() == EstimatorTraits::Bias::Unbiased;
    layer.pixels.resize(static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height));
    for (int y = 0; y < o.height && !stop; ++y) {
      parallelFor(static_cast<std::size_t>(o.width), [&](std::size_t i) {
        const int x = static_cast<int>(i);
        if (stop) return;
        layer.pixels[map.index(x, y)] =
            measurePixel(o, columns.at(x), estimator, columns.problem(map, estimator, x, y), map.index(x, y),
                         journal, stop);
      });
      progress.update(map.layers.size() * static_cast<std::size_t>(o.height) + static_cast<std::size_t>(y),
                      estimator.label());
    }
    map.layers.push_back(std::move(layer));
    if (stop) break;
  }
  return map;
}

int runHeatmap(const HeatmapOptions& o) {
  LabOptions lab = o.lab;
  std::string prefix = o.lab.outfile;
  if (const std::filesystem::path name = prefix;
      extensionOf(name) == ".csv" || extensionOf(name) == ".json" || extensionOf(name) == ".txt") {
    lab.format = tableFormat(o.lab);
    prefix = std::filesystem::path(name).replace_extension().string();
  }
  if (!lab.format) lab.format = prefix.empty() ? tableFormat(o.lab) : TableFormat::Csv;
  if (!prefix.empty()) lab.outfile = prefix + std::string(extensionOf(*lab.format));
  if (!prefix.empty()) checkWritable(prefix + "-variance-lookups.png");  // the longest name of all
  checkOutput(lab);
  const ThreadLimit limit(o.lab.threads);
  const StopSignal stop;
  std::vector<LabTable::Skipped> skipped;
  const Heatmap map = measureHeatmap(o, skipped, stop);
  LabTable table = tableOf(o, nameOfDensity(o), map);
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  noteShares(table, map);
  table.note(map.quantity == Quantity::Transmittance ? "law of the transmittance: " + map.law
                                                     : "quantity: reciprocal, 1 / depth");
  if (stop) table.markStopped();
  if (map.layers.empty()) throw std::runtime_error("nothing could be run");
  if (!prefix.empty()) {
    writeImage(prefix + ".exr", heatmapChannels(map, o.lab.command, !o.lab.omitSeconds),
               {.pixelType = PixelType::Float});
    for (const auto& [measure, suffix] : {std::pair{Measure::Variance, "-variance.png"},
                                          {Measure::VarianceLookups, "-variance-lookups.png"},
                                          {Measure::VarianceSeconds, "-variance-seconds.png"}}) {
      if (measure == Measure::VarianceSeconds && o.lab.omitSeconds) continue;
      writeImage(prefix + suffix, heatmapPicture(map, measure, nameOfDensity(o)));
    }
  }
  writeTable(table, lab);
  return 0;
}

}  // namespace pbrtmedia
