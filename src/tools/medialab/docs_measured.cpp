// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/docs_measured.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "fields/canonical_function.h"
#include "tools/medialab/estimate.h"

namespace pbrtmedia {
namespace {

/// The measured tables: one depth and control, and the functions that tell estimators apart.
const std::vector<std::string> kFunctions{"constant",  "cosine", "gaussian",  "hole",
                                          "linear-up", "step",   "fractal-a", "piecewise-random"};
constexpr double kControl = 1.1;
constexpr double kDepths[] = {0.1, 1, 4};
/// Those of reciprocals: above 0 everywhere.
const std::vector<std::string> kPositiveFunctions{"constant", "composite-sine", "gaussian-m23",
                                                  "step",     "spike",          "fractal-a"};
constexpr double kLooseControl = 1.5;

/// Three significant digits.
std::string brief(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  return text;
}

/// Standard deviations below this part of T are rounding.
constexpr double kMeasuredRounding = 1e-9;

struct Measured {
  double value;  ///< variance times cost
  double bias;   ///< relative error of the mean; 0 for an unbiased estimator
  bool canWin;   ///< unbiased, and under the exponential law like most
};

std::string cellText(const Measured& m, bool isBest) {
  std::string text = m.value > 0 ? brief(m.value) : "0";
  if (isBest) text = "**" + text + "**";
  if (m.bias != 0) text += " (bias " + brief(m.bias) + ")";
  return text;
}

/// The cells of one depth by estimator and function.
std::map<std::pair<std::string, std::string>, Measured> measuredCells(const LabTable& table, double depth,
                                                                      const char* cost, double unit) {
  const std::size_t estimatorAt = table.column("estimator"), functionAt = table.column("extinction"),
                    depthAt = table.column("depth"), costAt = table.column(cost),
                    varianceAt = table.column("variance"), meanAt = table.column("mean"),
                    exactAt = table.column("exact");
  std::map<std::pair<std::string, std::string>, Measured> cells;
  for (const auto& row : table.rows()) {
    if (row[depthAt].number() != depth) continue;
    const LabEstimator estimator(row[estimatorAt].text());
    const bool isUnbiased = estimator.bias() == EstimatorTraits::Bias::Unbiased;
    const double exact = row[exactAt].number(), variance = row[varianceAt].number();
    const double rounding = kMeasuredRounding * exact;
    cells[{row[estimatorAt].text(), row[functionAt].text()}] = {
        variance > rounding * rounding ? variance * row[costAt].number() * unit : 0,
        isUnbiased ? 0 : row[meanAt].number() / exact - 1,
        isUnbiased && (estimator.quantity() != Quantity::Transmittance ||
                       std::holds_alternative<ExponentialLaw>(estimator.law()))};
  }
  return cells;
}

/// One table of variance times a cost: estimators down, functions across, the least of each function in bold.
void printMeasured(std::ostream& out, const LabTable& table, const std::vector<std::string>& functions,
                   const std::vector<std::string_view>& estimators, double depth, const char* cost,
                   double unit) {
  const auto cells = measuredCells(table, depth, cost, unit);
  std::map<std::string, double> least;
  for (const auto& [at, cell] : cells) {
    if (!cell.canWin) continue;
    const auto [best, isFirst] = least.emplace(at.second, cell.value);
    if (!isFirst && cell.value < best->second) best->second = cell.value;
  }
  out << "\n| estimator |";
  for (const std::string& f : functions) out << ' ' << f << " |";
  out << "\n| --- |";
  for (std::size_t i = 0; i < functions.size(); ++i) out << " --- |";
  out << '\n';
  for (const std::string_view name : estimators) {
    out << "| `" << name << "` |";
    for (const std::string& f : functions) {
      const auto cell = cells.find({std::string(name), f});
      out << ' ';
      if (cell != cells.end()) {
        out << cellText(cell->second, cell->second.canWin && cell->second.value == least[f]);
      }
      out << " |";
    }
    out << '\n';
  }
}

EstimateOptions measured(const DocsOptions& o, const std::vector<std::string>& functions,
                         const std::vector<double>& depths, double control, const std::string& quantity) {
  EstimateOptions e;
  e.lab = o.lab;
  e.functions.words = functions;
  e.problem.depths = depths;
  e.problem.controls = {control};
  e.trials = o.trials;
  e.lab.command = "medialab estimate " + quantity + "--extinction ";
  for (const std::string& f : functions) e.lab.command += f + (f == functions.back() ? "" : ",");
  e.lab.command += " --depth ";
  for (const double depth : depths)
    e.lab.command += formatNumber(depth) + (depth == depths.back() ? "" : ",");
  e.lab.command += " --control " + formatNumber(control) + " --trials " + std::to_string(o.trials) +
                   " --seed " + std::to_string(o.lab.seed);
  return e;
}
EstimateOptions measured(const DocsOptions& o) {
  return measured(o, kFunctions, {std::begin(kDepths), std::end(kDepths)}, kControl, "");
}
EstimateOptions measuredReciprocals(const DocsOptions& o) {
  EstimateOptions e = measured(o, kPositiveFunctions, {1}, kLooseControl, "--quantity reciprocal ");
  e.selection.quantity = Quantity::Reciprocal;
  return e;
}

/// 1/F scales with F, and so does every estimate: one depth tells all.
void printReciprocalMeasurements(std::ostream& out, const LabTable& table, const DocsOptions& o) {
  out << "\n### Measured reciprocals: variance x look-ups\n\nAt depth 1 (1/F and all its estimates scale "
         "with 1/F), "
         "under a constant control "
      << formatNumber(kLooseControl)
      << " times the maximum, on functions\nthat stay above 0. Bold: the least among the unbiased "
         "estimators.\n\n```\n"
      << measuredReciprocals(o).lab.command << "\n```\n";
  printMeasured(out, table, kPositiveFunctions, reciprocalNames(), 1, "lookups", 1);
}

void printMeasurements(std::ostream& out, const LabTable& table, const DocsOptions& o) {
  out << "\n## Measured\n\nVariance times cost of one estimate, with default parameters, on the canonical "
         "functions"
         " (`medialab list functions`)\nunder a constant control "
      << kControl
      << " times the maximum, one super-voxel, no minorant. Lower is better. Bold: the least of each column "
         "among"
         " the\nunbiased estimators of the exponential law; those of pink noise answer another question. "
         "Beside an"
         " estimator that is\nbiased, or only consistent, stands the relative error of its mean. 0: all "
         "estimates"
         " agreed to nine digits. Empty: not\napplicable. Variances of estimators whose values spread widely "
         "are"
         " uncertain themselves: `medialab estimate` tells by how\nmuch. The 32 points of `ray-marching` "
         "meet "
         "the 32 cells of piecewise-random one by one: exact there by accident.\n\nThe rows behind these "
         "tables:\n\n```\n"
      << measured(o).lab.command << "\n```\n";
  for (const double depth : kDepths) {
    out << "\n### Optical depth " << formatNumber(depth) << ": variance x look-ups\n";
    printMeasured(out, table, kFunctions, estimatorNames(), depth, "lookups", 1);
    if (o.lab.omitSeconds) continue;
    out << "\n### Optical depth " << formatNumber(depth) << ": variance x nanoseconds\n\n"
        << "On one thread of the machine that made this page; look-ups here evaluate a formula, which costs\n"
           "between a few and 150 ns.\n";
    printMeasured(out, table, kFunctions, estimatorNames(), depth, "seconds_per_estimate", 1e9);
  }
}

/// The estimator that is ours against that which was the best before it: all functions, and controls enough
/// that the luck of a comb whose spacing meets a frequency of the function averages out.
const std::string kOurs = "telescoping-ray-marching", kRival = "unbiased-ray-marching";
const std::vector<double> kDuelControls{1, 1.5, 2.5, 5, 10};

EstimateOptions duel(const DocsOptions& o) {
  EstimateOptions e;
  e.lab = o.lab;
  e.selection.estimators = {kRival, kOurs};
  e.problem.depths = {std::begin(kDepths), std::end(kDepths)};
  e.problem.controls = kDuelControls;
  e.trials = o.trials;
  e.lab.command = "medialab estimate --estimator " + kRival + "," + kOurs + " --depth 0.1,1,4 --control ";
  for (const double control : kDuelControls) {
    e.lab.command += formatNumber(control) + (control == kDuelControls.back() ? "" : ",");
  }
  e.lab.command += " --trials " + std::to_string(o.trials) + " --seed " + std::to_string(o.lab.seed);
  return e;
}

/// One function's cells: variance x cost of ours over that of the rival.
struct Duel {
  double logSum = 0, logVariance = 0;  ///< of the mean's terms
  double worst = 0;
  int cells = 0, won = 0, exact = 0;  ///< exact: ours alone has no variance

  std::string mean() const {
    if (cells == 0) return "";
    const double half = 1.96 * std::sqrt(logVariance) / cells, log = logSum / cells;
    char text[64];
    std::snprintf(text, sizeof text, "%.2g (%.2g – %.2g)", std::exp(log), std::exp(log - half),
                  std::exp(log + half));
    return text;
  }
};

std::map<std::string, Duel> duelsBy(const LabTable& table, const char* cost) {
  const auto at = [&](const char* name) { return table.column(name); };
  struct Side {
    double costliness, relativeError;
    bool isExact;
  };
  std::map<std::tuple<std::string, double, double>, Side> rivals;
  std::map<std::string, Duel> duels;
  for (const auto& row : table.rows()) {
    const double exact = row[at("exact")].number(), variance = row[at("variance")].number();
    const std::string function = row[at("extinction")].text();
    const Side side{variance * row[at(cost)].number(), row[at("variance_stderr")].number() / variance,
                    !(variance > kMeasuredRounding * kMeasuredRounding * exact * exact)};
    const std::tuple key{function, row[at("depth")].number(), row[at("control")].number()};
    if (row[at("estimator")].text() == kRival) {
      rivals.emplace(key, side);
      continue;
    }
    const Side& rival = rivals.at(key);
    Duel& duel = duels[function];
    if (rival.isExact) continue;
    if (side.isExact) {
      ++duel.exact;
      continue;
    }
    const double ratio = side.costliness / rival.costliness;
    ++duel.cells;
    duel.logSum += std::log(ratio);
    duel.logVariance += side.relativeError * side.relativeError + rival.relativeError * rival.relativeError;
    duel.worst = std::max(duel.worst, ratio);
    duel.won += ratio < 1 ? 1 : 0;
  }
  return duels;
}

void printDuel(std::ostream& out, const LabTable& table, const DocsOptions& o) {
  out << R"(
## Telescoping against unbiased ray marching

Variance x cost of `telescoping-ray-marching` over that of `unbiased-ray-marching`, both with default parameters: below 1 it wins. Geometric means
over the optical depths and controls of the command below, with intervals of 95 %; the worst of these cells; and of how many cells (those where the
rival's estimates agree to nine digits are left out) it wins, those where its own agree to nine digits included.

- **Why.** Nearly all of the cost is one comb (of unbiased ray marching: three quarters), and combs with matched ends converge faster than their cost
  grows, so that `tuplescale` 1.5 is better than 1 in this product; at 1 the gain is smaller, but there.
- **Where it loses.** A comb whose spacing, or a fraction of it, meets a frequency of the density has no more than one tooth's knowledge of it, and one
  whose teeth fall on jumps alike has no error: either estimator is lucky in some cells, the worst below are those where the other one was. Drawing
  the number of teeth at random removes the luck of both kinds, and costs more than it gains. Behind bounds with means, `warp` spreads the teeth of
  the smaller comb where it leaves the larger one straight: densities that are constant in each super-voxel are then better served by the smaller.
- **Tails.** Corrections are rare, one in ten to one in a hundred, and weigh the inverse. `correctionprobability` makes them more frequent.

)";
  out << "```\n" << duel(o).lab.command << "\n```\n\n| function | look-ups |";
  const bool hasSeconds = !o.lab.omitSeconds;
  if (hasSeconds) out << " nanoseconds |";
  out << " worst by look-ups | wins |\n| --- | --- | --- | --- |" << (hasSeconds ? " --- |" : "") << '\n';
  const auto lookups = duelsBy(table, "lookups");
  const auto seconds = hasSeconds ? duelsBy(table, "seconds_per_estimate") : lookups;
  for (const std::string_view name : canonicalFunctionNames()) {
    const Duel& one = lookups.at(std::string(name));
    if (one.cells + one.exact == 0) continue;
    out << "| " << name << " | " << one.mean() << " |";
    if (hasSeconds) out << ' ' << seconds.at(std::string(name)).mean() << " |";
    out << ' ' << brief(one.cells > 0 ? one.worst : 0) << " | " << one.won + one.exact << " of "
        << one.cells + one.exact << " |\n";
  }
}

}  // namespace

DocsTables measureDocs(const DocsOptions& o, const StopSignal& stop) {
  return {estimateTable(measured(o), stop), estimateTable(measuredReciprocals(o), stop),
          estimateTable(duel(o), stop)};
}

void printTables(std::ostream& out, const DocsTables& tables, const DocsOptions& o) {
  printReciprocalMeasurements(out, tables.reciprocals, o);
  printMeasurements(out, tables.estimators, o);
  printDuel(out, tables.duels, o);
}

}  // namespace pbrtmedia
