// SPDX-License-Identifier: BSD-2-Clause
#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <string>

#include "tools/medialab/converge.h"
#include "tools/medialab/docs.h"
#include "tools/medialab/estimate.h"
#include "tools/medialab/heatmap.h"
#include "tools/medialab/list.h"
#include "tools/medialab/precision.h"
#include "tools/medialab/profile.h"
#include "tools/medialab/stress.h"
#include "tools/run_tool.h"

// Each `addX` declares one command and stores in `run` what it does; the options live as long as the program.

namespace pbrtmedia {
namespace {

using Run = std::function<int()>;

constexpr unsigned kMostThreads = 4096;
/// Beyond, a row would take weeks; far below what counters hold.
constexpr unsigned long long kMostTrials = 1'000'000'000'000;
constexpr unsigned kMostSamples = 1u << 24;

/// Of a command that writes a table.
void addTableOptions(CLI::App* c, LabOptions& o) {
  c->add_option("-o,--outfile", o.outfile, "file to write, .csv, .json or .txt (standard output)");
  std::map<std::string, TableFormat> formats;
  for (const auto& [name, format] : kTableFormats) formats.emplace(name, format);
  c->add_option("--format", o.format,
                "csv, json or text (as the file's name ends; without a file text on a terminal, else csv)")
      ->transform(oneOf(formats))
      ->type_name("NAME");
}

/// The words that were typed, told apart by what they are for.
struct Words {
  std::string command, identity;
};

void addLabOptions(CLI::App* c, LabOptions& o, const Words& words) {
  o.command = words.command;
  o.identity = words.identity;
  c->add_option("--seed", o.seed, "of all random numbers (1)")->check(wholeNumber<std::uint64_t>(0, ~0ull));
  c->add_option("--nthreads,--threads", o.threads, "0: one per processor (0); results do not depend on it")
      ->check(wholeNumber(0u, kMostThreads))
      ->type_name("N");
  c->add_flag("--quiet", o.quiet, "show no progress");
  c->add_flag("--no-seconds", o.omitSeconds, "leave out measured times, all that differs from run to run");
}

/// Of a command whose measurements may be kept while they are made.
void addResume(CLI::App* c, LabOptions& o) {
  c->add_option("--resume", o.resume,
                "file that keeps what is measured: the same command goes on where it was stopped or killed");
}

void addSelection(CLI::App* c, EstimatorSelection& o) {
  c->add_option("--estimator", o.estimators,
                "names, names with parameters (ray-marching:stepsize=0.1), or all (all)")
      ->delimiter(',')
      ->take_all();
  c->add_option("--law", o.law, "transmittance law (each estimator's own, mostly exponential)");
  c->add_option("--param", o.params, "name=value of the law and of every estimator chosen");
}

void addProblem(CLI::App* c, ProblemOptions& o, bool hasDepths) {
  if (hasDepths) {
    c->add_option("--depth", o.depths, "optical depths (1)")
        ->delimiter(',')
        ->take_all()
        ->check(number(NumberRange::atLeast(0)));
    CLI::Option* control =
        c->add_option("--control", o.controls, "upper control / largest density (1); below 1 it is no bound")
            ->delimiter(',')
            ->take_all()
            ->check(number(NumberRange::above(0)));
    c->add_option("--efficiency", o.efficiencies, "instead of --control: depth / depth of the control")
        ->delimiter(',')
        ->take_all()
        ->check(number(NumberRange::above(0)))
        ->excludes(control);
  }
  c->add_option("--lower", o.lowers, "lower control / smallest density (0: none)")
      ->delimiter(',')
      ->take_all()
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--supervoxels", o.superVoxels, "intervals with controls of their own (1)")
      ->check(wholeNumber(1u, ProblemOptions::kMostSuperVoxels));
  c->add_option("--length", o.length, "of the segment (the width of the function, mostly 1)")
      ->check(number(NumberRange::above(0)));
  c->add_option("--offset", o.offset, "of the segment's start (0)")->check(number(NumberRange::any()));
  c->add_flag("--paper-depth", o.isPaperDepth,
              "a depth is the papers' factor of the formula, not the true depth; they differ for cosine");
  c->add_flag("--no-means", o.noMeans, "intervals do not know their mean density");
}

void addVolumes(CLI::App* c, FunctionSelection& o) {
  c->add_option("--ray", o.ray, "through an .nvdb file, in its world space: ox oy oz dx dy dz")
      ->expected(6)
      ->check(number(NumberRange::any()));
  c->add_option("--grid", o.grid, "of an .nvdb file with several: name, number or beginning of a name");
}

void addFunctions(CLI::App* c, FunctionSelection& o, const std::string& fallback) {
  c->add_option("--extinction", o.words,
                "names of functions or all, tables x,density (.csv), volumes (.nvdb) " + fallback)
      ->delimiter(',')
      ->take_all();
  addVolumes(c, o);
}

void addFunction(CLI::App* c, FunctionSelection& o) {
  c->add_option("--extinction", o.words, "function, table x,density (.csv) or volume (.nvdb) (cosine)")
      ->expected(1);
  addVolumes(c, o);
}

void addPattern(CLI::App* c, PatternKind& pattern) {
  std::map<std::string, PatternKind> names;
  for (std::size_t i = 0; i < kPatternNames.size(); ++i) {
    names[std::string(kPatternNames[i])] = static_cast<PatternKind>(i);
  }
  c->add_option("--pattern", pattern, "of the random numbers of the estimates in a trial (independent)")
      ->transform(oneOf(names))
      ->type_name("NAME");
}

void addList(CLI::App& app, ListOptions& o, Run& run) {
  CLI::App* c =
      app.add_subcommand("list", "List estimators with traits and parameters, functions, laws, patterns");
  c->add_option("what", o.what, "estimators, functions, laws, patterns or all (all)")
      ->transform(oneOf({"estimators", "functions", "laws", "patterns", "all"}));
  const std::map<std::string, bool> formats{{"text", false}, {"json", true}};
  c->add_option("--format", o.json, "text (default) or json")->transform(oneOf(formats))->type_name("NAME");
  c->callback([&o, &run] { run = [&o] { return runList(o); }; });
}

void addEstimate(CLI::App& app, EstimateOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("estimate", "Measure mean, variance and cost of estimators");
  c->footer(
      "A row for each estimator, function, depth, control and lower control. A trial is the mean of\n"
      "--samples-per-estimate estimates; all columns speak of one trial. non_finite counts trials that were\n"
      "NaN or infinite; mean and variance leave them out.");
  addLabOptions(c, o.lab, words);
  addTableOptions(c, o.lab);
  addResume(c, o.lab);
  addSelection(c, o.selection);
  addFunctions(c, o.functions, "(all)");
  addProblem(c, o.problem, true);
  addPattern(c, o.plan.pattern);
  c->add_option("--samples-per-estimate", o.plan.samples, "estimates averaged by a trial (1)")
      ->check(wholeNumber(1u, kMostSamples));
  c->add_option("--trials", o.trials, "of each row (10000)")->check(wholeNumber(2ull, kMostTrials));
  c->callback([c, &o, &run] {
    o.showLaw = c->count("--law") > 0;
    o.showPattern = c->count("--pattern") > 0;
    o.showLower = c->count("--lower") > 0;
    run = [&o] { return runEstimate(o); };
  });
}

void addHeatmap(CLI::App& app, HeatmapOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("heatmap", "Map variance and cost over transmittance and control");
  c->footer(
      "Transmittance, under the law, runs from 0.99 at the left to 0.01 at the right, depth / depth of\n"
      "the control from 0.01 at the bottom to the function's largest at the top. With --outfile P writes\n"
      "P.csv (or P.json), P.exr, P-variance.png, P-variance-lookups.png and P-variance-seconds.png. The\n"
      "best is chosen among the unbiased estimators, which must serve one law; all: those of the\n"
      "exponential one, unless --law tells another.");
  addLabOptions(c, o.lab, words);
  addTableOptions(c, o.lab);
  addResume(c, o.lab);
  addSelection(c, o.selection);
  addFunction(c, o.function);
  addProblem(c, o.problem, false);
  addPattern(c, o.plan.pattern);
  c->add_option("--samples-per-estimate", o.plan.samples, "estimates averaged by a trial (1)")
      ->check(wholeNumber(1u, kMostSamples));
  c->add_option("--width", o.width, "pixels (64)")->check(wholeNumber(1, 4096));
  c->add_option("--height", o.height, "pixels (64)")->check(wholeNumber(1, 4096));
  c->add_option("--top-efficiency", o.topEfficiency,
                "depth / depth of the control at the top (the function's)")
      ->check(number(NumberRange::above(0)));
  CLI::Option* lookups =
      c->add_option("--lookups", o.lookups,
                    "budget of a pixel and estimator (16384), or four times as many trials")
          ->check(wholeNumber(1ull, kMostTrials));
  c->add_option("--trials", o.trials, "of a pixel and estimator, instead of a budget")
      ->check(wholeNumber(2ull, kMostTrials))
      ->excludes(lookups);
  c->callback([&o, &run] { run = [&o] { return runHeatmap(o); }; });
}

void addConverge(CLI::App& app, ConvergeOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("converge", "Measure the error of the mean of 1, 2, 4, ... estimates");
  c->footer(
      "Slopes belong to straight lines through log(rmse), with standard errors from those of the points.");
  addLabOptions(c, o.lab, words);
  addTableOptions(c, o.lab);
  addResume(c, o.lab);
  addSelection(c, o.selection);
  addFunctions(c, o.functions, "(cosine)");
  addProblem(c, o.problem, true);
  addPattern(c, o.pattern);
  c->add_option("--doublings", o.doublings, "the largest mean has 2^doublings estimates (10)")
      ->check(wholeNumber(1u, 24u));
  c->add_option("--trials", o.trials, "means of each size (256)")->check(wholeNumber(4ull, kMostTrials));
  c->callback([&o, &run] { run = [&o] { return runConverge(o); }; });
}

void addProfile(CLI::App& app, ProfileOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("profile", "Show a line: extinction, controls, points of one estimate");
  addLabOptions(c, o.lab, words);
  addTableOptions(c, o.lab);
  addSelection(c, o.selection);
  addFunction(c, o.function);
  addProblem(c, o.problem, true);
  c->add_option("--points", o.points, "where the field is shown (256)")->check(wholeNumber(2u, 1000000u));
  c->add_option("--picture", o.picture, "image file to plot into: .png, .exr, .pfm or .tga");
  c->callback([&o, &run] { run = [&o] { return runProfile(o); }; });
}

void addStress(CLI::App& app, StressOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("stress", "Try estimators on stiff and extreme lines");
  c->footer(
      "Verdicts: pass; expected (what the traits predict cannot work); undecided (too few trials for\n"
      "so rare events); skipped; fail. Every cell runs in a process of its own with a limit on processor\n"
      "time. Exit status 1 when any verdict is fail, or missing as the run was stopped. Seconds are those\n"
      "of all trials of a cell. The whole table: medialab stress -o stress.csv, some five minutes on two\n"
      "processors.");
  addLabOptions(c, o.lab, words);
  addTableOptions(c, o.lab);
  addSelection(c, o.selection);
  c->add_option("--case", o.cases, "names of cases, or beginnings of names (all)")
      ->delimiter(',')
      ->take_all();
  c->add_flag("--quick", o.isQuick, "fewer cases and trials: seconds");
  c->callback([&o, &run] { run = [&o] { return runStress(o); }; });
}

void addPrecision(CLI::App& app, LabOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("precision", "Compare float with double where it matters");
  c->footer(
      "Runs ratio tracking, ray marching and 1 - T with positions, weights and sums in float and in\n"
      "double on the same random numbers.");
  addLabOptions(c, o, words);
  addTableOptions(c, o);
  c->callback([&o, &run] { run = [&o] { return runPrecision(o); }; });
}

void addDocs(CLI::App& app, DocsOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("docs", "Write the page docs/estimators.md, with measured tables");
  addLabOptions(c, o.lab, words);
  c->add_option("-o,--outfile", o.lab.outfile, "file to write, .md (standard output)");
  c->add_option("--trials", o.trials, "of each measured cell (20000)")->check(wholeNumber(2ull, kMostTrials));
  c->callback([&o, &run] { run = [&o] { return runDocs(o); }; });
}

}  // namespace

int medialabMain(int argc, char** argv) {
  CLI::App app{"Measures transmittance estimators on lines whose answers are known", "medialab"};
  app.require_subcommand(1);
  const Words words{commandText(argc, argv), identityText(argc, argv)};
  ListOptions list;
  EstimateOptions estimate;
  HeatmapOptions heatmap;
  ConvergeOptions converge;
  ProfileOptions profile;
  StressOptions stress;
  LabOptions precision;
  DocsOptions docs;
  Run run;
  addList(app, list, run);
  addEstimate(app, estimate, words, run);
  addHeatmap(app, heatmap, words, run);
  addConverge(app, converge, words, run);
  addProfile(app, profile, words, run);
  addStress(app, stress, words, run);
  addPrecision(app, precision, words, run);
  addDocs(app, docs, words, run);
  return runTool(app, argc, argv, run);
}

}  // namespace pbrtmedia

int main(int argc, char** argv) { return pbrtmedia::medialabMain(argc, argv); }
