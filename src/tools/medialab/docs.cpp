// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/docs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "base/writable.h"
#include "fields/canonical_function.h"
#include "freeflight/any_flight.h"
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

void printParameters(std::ostream& out, const std::vector<ParameterDescription>& parameters) {
  if (parameters.empty()) return;
  out << "\n| parameter | type | default | allowed | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const ParameterDescription& p : parameters) {
    out << "| `" << p.name << "` | " << p.type << " | " << p.value << " | " << p.allowed << " | " << p.help
        << " |\n";
  }
}

std::string joined(const std::vector<std::string_view>& words) {
  std::string out;
  for (const std::string_view word : words) {
    if (!out.empty()) out += ", ";
    out += word;
  }
  return out;
}

/// The first letter as a capital.
std::string sentence(std::string_view text) {
  std::string s(text);
  if (!s.empty() && s[0] >= 'a' && s[0] <= 'z') s[0] = static_cast<char>(s[0] - 'a' + 'A');
  if (!s.empty() && s.back() != '.') s += '.';
  return s;
}

const char* controlSentence(EstimatorTraits::Control control) {
  switch (control) {
    case EstimatorTraits::Control::Unused:
      return "No control.";
    case EstimatorTraits::Control::CostOnly:
      return "An upper control that sets the cost; the mean does not depend on it.";
    case EstimatorTraits::Control::Any:
      return "An upper control, positive where the extinction is; it may be too low.";
    case EstimatorTraits::Control::Bounding:
      return "An upper control that is a bound.";
  }
  return "";
}

void printEstimator(std::ostream& out, std::string_view name) {
  const LabEstimator estimator(name);
  const EstimatorTraits t = estimator.traits();
  out << "\n### `" << name << "`\n\n" << sentence(t.summary) << " Source: " << sentence(t.source) << "\n\n";
  out << "- **Needs.** " << controlSentence(t.control) << "\n";
  out << "- **Bias.** " << sentence(nameOf(t.bias));
  if (!t.biasNote.empty()) out << ' ' << sentence(t.biasNote);
  out << "\n- **Values.** "
      << (t.mayLeaveUnitInterval ? "May leave [0, 1]." : "In [0, 1] under a bounding control.")
      << " Variance: " << (t.finiteVariance ? "finite" : "infinite")
      << "; under a control too low by any factor: " << (t.finiteVarianceUnbounded ? "finite" : "infinite")
      << ".\n";
  if (t.tellsSpread)
    out << "- **Noise.** Each estimate tells its own, for `\"string mistransmittance\"` of `volpath`.\n";
  out << "- **Cost.** " << (t.boundedCost ? "Bounded." : "Unbounded.") << "\n";
  out << "- **Laws.** " << sentence(joined(t.laws.names())) << "\n";
  out << "- **Use when** " << t.useWhen << ".\n";
  printParameters(out, estimator.parameters());
}

void printLaws(std::ostream& out) {
  out << "\n## Laws\n\nA law turns the optical depth F into transmittance.\n";
  for (const std::string_view name : lawNames()) {
    const AnyLaw law = *findLaw(name);
    out << "\n### `" << name << "`\n\n`"
        << std::visit([](const auto& held) { return std::string_view(held.kFormula); }, law) << "`\n";
    printParameters(out, parametersOf(law));
  }
}

void printReciprocal(std::ostream& out, std::string_view name) {
  const AnyReciprocal estimator = *findReciprocal(name);
  const ReciprocalTraits t = traitsOf(estimator);
  out << "\n### `" << name << "`\n\n" << sentence(t.summary) << " Source: " << sentence(t.source) << "\n\n";
  out << "- **Needs.** " << controlSentence(t.control) << "\n";
  out << "- **Bias.** " << sentence(nameOf(t.bias));
  if (!t.biasNote.empty()) out << ' ' << sentence(t.biasNote);
  out << "\n- **Domain.** " << sentence(t.domain) << "\n";
  out << "- **Variance.** "
      << (t.finiteVariance ? "Finite in the domain under a bounding control"
                           : "Finite in a part of the domain");
  if (!t.varianceNote.empty()) out << ": " << t.varianceNote;
  out << ".\n- **Cost.** " << t.cost << (t.boundedCost ? ", bounded" : ", unbounded") << ".\n";
  out << "- **Use when** " << t.useWhen << ".\n";
  printParameters(out, parametersOf(estimator));
}

/// Unbiased estimates of 1/F, and their table.
void printReciprocals(std::ostream& out) {
  out << R"(
## Reciprocals

`medialab estimate --quantity reciprocal` measures estimators of 1/F, F > 0 being the optical depth, or any integral, of which
only estimates are known. Normalising a pdf that is itself an integral asks for it, and so does dividing by the probability that a random
process finds what it has found (specular manifold sampling); 1 over an estimate is biased. `alpha` is the integral of the upper control, `F_i`
the estimate of F that one factor of a series is made of. Nothing of these estimators but their look-ups knows of lines:
`reciprocal/geometric_series.h` takes any estimates, or events.

| estimator | bias | control | domain | finite variance | look-ups |
| --- | --- | --- | --- | --- | --- |
)";
  for (const std::string_view name : reciprocalNames()) {
    const ReciprocalTraits t = traitsOf(*findReciprocal(name));
    out << "| [`" << name << "`](#" << name << ") | " << nameOf(t.bias) << " | " << nameOf(t.control) << " | "
        << t.domain << " | " << (t.finiteVariance ? "yes" : "in part") << " | " << t.cost << " |\n";
  }
  for (const std::string_view name : reciprocalNames()) printReciprocal(out, name);
}

const char* weightsOf(const FlightTraits& t) {
  if (t.unitWeights) return "1";
  return t.mayBeNegative ? "any sign" : "positive";
}

/// Free flights, which the lab does not measure.
void printFlights(std::ostream& out) {
  out << R"(
## Free flights

`"string freeflight"` of a medium names one of these; its parameters stand in the same entry. *Weights* are those in grey media
under a bounding control. The laws that are mixtures of exponential ones are served by null collisions, exactly: the tentative collisions are
those of a medium whose extinction has a random factor.

| flight | bias | control | weights | laws | how |
| --- | --- | --- | --- | --- | --- |
)";
  for (const std::string_view name : flightNames()) {
    const FlightTraits t = traitsOf(*findFlight(name));
    out << "| `" << name << "` | " << nameOf(t.bias) << " | " << nameOf(t.control) << " | " << weightsOf(t)
        << " | " << (t.laws == LawSet::all() ? "all" : joined(t.laws.names())) << " | " << t.summary << ". "
        << sentence(t.source) << ' ' << (t.biasNote.empty() ? "" : sentence(t.biasNote) + ' ') << "Use when "
        << t.useWhen << ". |\n";
  }
  out << "\n| flight | parameter | type | default | allowed | meaning |\n| --- | --- | --- | --- | --- | --- "
         "|\n";
  for (const std::string_view name : flightNames()) {
    for (const ParameterDescription& p : parametersOf(*findFlight(name))) {
      out << "| `" << name << "` | `" << p.name << "` | " << p.type << " | " << p.value << " | " << p.allowed
          << " | " << p.help << " |\n";
    }
  }
}

/// Three significant digits.
std::string brief(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  return text;
}

/// Standard deviations below this part of T are rounding.
constexpr double kRounding = 1e-9;

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
    const double rounding = kRounding * exact;
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
                    !(variance > kRounding * kRounding * exact * exact)};
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

void printLab(std::ostream& out) {
  out << R"(
## The lab

`medialab COMMAND --help` tells all options; CSV and JSON begin with the command that repeats them. `--resume FILE` (of `estimate`,
`converge`, `heatmap`) keeps what is measured: the same command goes on where it was stopped or killed.

```
medialab list                                                                      # this page's first half, as text or JSON
medialab estimate --estimator all --extinction cosine --depth 1,4 --control 1,2    # mean, variance, cost, with errors
medialab heatmap --extinction gaussian -o gaussian                                 # over transmittance and control: CSV, EXR, PNG
medialab estimate --quantity reciprocal --extinction composite-sine --control 1,2    # unbiased estimates of 1 / depth
medialab heatmap --extinction gaussian-m22 --rows control --row-range 1 5 -o maps  # the axes of Misso et al. 2022
medialab converge --estimator ratio,unbiased-ray-marching -o converge.csv          # error against samples, look-ups, seconds
medialab profile --estimator ratio --supervoxels 8 --lower 1 --picture line.png    # one line, its controls, its look-ups
medialab heatmap --family slab --estimator p-series-cmf,unbiased-ray-marching -o slab # densities that get rougher, from clear to opaque
medialab levels --estimator debiased-ray-marching:levels=0:comb=independent        # variance and cost of corrections, level by level
medialab running --estimator ratio --extinction step-sine --depth 12.66 --to 3     # weights of walks along a line
medialab progressive --supervoxels 80 --epsilon 0.2                                # bounds that rise from pass to pass
medialab power-law --doublings 18                                                  # means whose variance is infinite
medialab stress -o stress.csv                                                      # all on stiff and extreme lines: ten minutes of processor time
medialab precision                                                                 # float against double where it matters
```
)";
}

}  // namespace

std::string docsPage(const DocsOptions& o, const StopSignal& stop) {
  std::ostringstream out;
  out << "# Transmittance estimators\n\n"
         "This page is generated: `"
      << o.lab.command
      << "`. It says what `medialab list` says, and what a run measured.\n\n"
         "Scene files choose an estimator by its keyword in `\"string transmittance\"` of a medium and give "
         "its"
         " parameters in the\nsame entry; the lab takes the same names. A *control* is a bound of the "
         "extinction"
         " by super-voxels: the upper one is\nthe majorant, the lower one the minorant. *Unbiased* means "
         "that the"
         " mean is the transmittance exactly; *consistent*,\nthat it becomes so as the cost of one estimate"
         " grows; *biased*, neither.\n\n"
         "| estimator | bias | control | in [0, 1] | finite variance | bounded cost | laws |\n"
         "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::string_view name : estimatorNames()) {
    const EstimatorTraits t = LabEstimator(name).traits();
    const bool servesAll = t.laws == LawSet::all();
    out << "| [`" << name << "`](#" << name << ") | " << nameOf(t.bias) << " | " << nameOf(t.control) << " | "
        << (t.mayLeaveUnitInterval ? "no" : "yes") << " | " << (t.finiteVariance ? "yes" : "no") << " | "
        << (t.boundedCost ? "yes" : "no") << " | " << (servesAll ? "all" : joined(t.laws.names())) << " |\n";
  }
  out << "\n## Estimators\n";
  for (const std::string_view name : estimatorNames()) printEstimator(out, name);
  printLaws(out);
  printFlights(out);
  printReciprocals(out);
  const LabTable table = estimateTable(measured(o), stop);
  const LabTable reciprocals = estimateTable(measuredReciprocals(o), stop);
  const LabTable duels = estimateTable(duel(o), stop);
  if (stop) throw std::runtime_error("stopped: no page is written");
  printReciprocalMeasurements(out, reciprocals, o);
  printMeasurements(out, table, o);
  printDuel(out, duels, o);
  printLab(out);
  return out.str();
}

int runDocs(const DocsOptions& options) {
  const std::string& name = options.lab.outfile;
  if (!name.empty() && extensionOf(name) != ".md") {
    throw std::runtime_error(name + ": unknown extension; the page is Markdown: .md");
  }
  if (!name.empty()) checkWritable(name);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  const std::string page = docsPage(options, stop);
  writeOutput(options.lab.outfile, [&](std::ostream& out) { out << page; });
  return 0;
}

}  // namespace pbrtmedia
