// SPDX-License-Identifier: BSD-2-Clause
#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "tools/medialab/command_options.h"
#include "tools/medialab/converge.h"
#include "tools/medialab/docs.h"
#include "tools/medialab/estimate.h"
#include "tools/medialab/heatmap.h"
#include "tools/medialab/line_commands.h"
#include "tools/medialab/list.h"
#include "tools/medialab/precision.h"
#include "tools/medialab/profile.h"
#include "tools/medialab/stress.h"
#include "tools/run_tool.h"

// Each `addX` declares one command and stores in `run` what it does; the options live as long as the program.

namespace pbrtmedia {
namespace {

void addList(CLI::App& app, ListOptions& o, Run& run) {
  CLI::App* c =
      app.add_subcommand("list", "List estimators with traits and parameters, functions, laws, patterns");
  c->add_option("what", o.what, "estimators, reciprocals, flights, functions, laws, patterns or all (all)")
      ->transform(oneOf({"estimators", "reciprocals", "flights", "functions", "laws", "patterns", "all"}));
  const std::map<std::string, bool> formats{{"text", false}, {"json", true}};
  c->add_option("--format", o.json, "text (default) or json")->transform(oneOf(formats))->type_name("NAME");
  runWhenChosen(c, run, o, runList);
}

void addEstimate(CLI::App& app, EstimateOptions& o, const Words& words, Run& run) {
  CLI::App* c =
      addTableCommand(app, "estimate", "Measure mean, variance and cost of estimators", o.lab, words);
  c->footer(
      "A row for each estimator, function, depth, control and lower control. A trial is the mean of\n"
      "--samples-per-estimate estimates; all columns speak of one trial. non_finite counts trials that were\n"
      "NaN or infinite; mean and variance leave them out.");
  addResume(c, o.lab);
  addMeasured(c, o.selection);
  addFunctions(c, o.functions, "(all)");
  addProblem(c, o.problem, true);
  addPlan(c, o.plan);
  c->add_option("--trials", o.trials, "of each row (10000)")->check(wholeNumber(2ull, kMostTrials));
  c->callback([c, &o, &run] {
    o.showLaw = c->count("--law") > 0;
    o.showPattern = c->count("--pattern") > 0;
    o.showLower = c->count("--lower") + c->count("--lower-depth") > 0;
    run = [&o] { return runEstimate(o); };
  });
}

/// What the words for axes are read into.
struct HeatmapWords : HeatmapOptions {
  std::vector<double> answerRange, rowEnds;
};

/// Densities that change from column to column.
void addFamily(CLI::App* c, HeatmapWords& o) {
  CLI::Option* family =
      c->add_option(
           "--family", o.family,
           "a density for each column in place of --extinction, and depths for rows: slab, rougher to the "
           "right (Kettunen et al. 2021, figures 14 and 15)")
          ->type_name("NAME");
  c->add_option("--control", o.problem.controls, "with --family: upper control / largest density (1)")
      ->expected(1)
      ->check(number(NumberRange::above(0)))
      ->needs(family);
  c->add_flag("--shared-control", o.isControlShared,
              "with --family: one control for all columns, that of the densest")
      ->needs(family);
}

void addHeatmap(CLI::App& app, HeatmapWords& o, const Words& words, Run& run) {
  CLI::App* c =
      addTableCommand(app, "heatmap", "Map variance and cost over transmittance and control", o.lab, words);
  c->footer(
      "Transmittance, under the law, runs from 0.99 at the left to 0.01 at the right, depth / depth of\n"
      "the control from 0.01 at the bottom to the function's largest at the top. --rows control puts the\n"
      "control over the largest density there, from 1 to 2. With --outfile P writes\n"
      "P.csv (or P.json), P.exr, P-variance.png, P-variance-lookups.png and P-variance-seconds.png. The\n"
      "best is chosen among the unbiased estimators, which must serve one law; all: those of the\n"
      "exponential one, unless --law tells another.");
  addResume(c, o.lab);
  addMeasured(c, o.selection);
  addFunction(c, o.function);
  addProblem(c, o.problem, false);
  addPlan(c, o.plan);
  c->add_option("--width", o.width, "pixels (64)")->check(wholeNumber(1, 4096));
  c->add_option("--height", o.height, "pixels (64)")->check(wholeNumber(1, 4096));
  c->add_option("--range", o.answerRange,
                "transmittance, or reciprocal, at the left and at the right (0.99 0.01)")
      ->expected(2)
      ->check(number(NumberRange::above(0)));
  const std::map<std::string, HeatmapRows> rows{{"efficiency", HeatmapRows::Efficiency},
                                                {"control", HeatmapRows::Control}};
  c->add_option("--rows", o.rows,
                "what rows run over: efficiency (depth / depth of the control), or control (over the largest "
                "density) (efficiency)")
      ->transform(oneOf(rows))
      ->type_name("NAME");
  c->add_option(
       "--row-range", o.rowEnds,
       "of the rows, at the bottom and at the top (efficiency: 0.01 and the function's; control: 1 2)")
      ->expected(2)
      ->check(number(NumberRange::above(0)));
  CLI::Option* lookups =
      c->add_option("--lookups", o.lookups,
                    "budget of a pixel and estimator (16384), or four times as many trials")
          ->check(wholeNumber(1ull, kMostTrials));
  c->add_option("--trials", o.trials, "of a pixel and estimator, instead of a budget")
      ->check(wholeNumber(2ull, kMostTrials))
      ->excludes(lookups);
  addFamily(c, o);
  c->callback([&o, &run] {
    if (!o.answerRange.empty()) o.answers = {o.answerRange[0], o.answerRange[1]};
    if (!o.rowEnds.empty()) o.rowRange = HeatmapAxis{o.rowEnds[0], o.rowEnds[1]};
    run = [&o] { return runHeatmap(o); };
  });
}

void addConverge(CLI::App& app, ConvergeOptions& o, const Words& words, Run& run) {
  CLI::App* c = addTableCommand(app, "converge", "Measure the error of the mean of 1, 2, 4, ... estimates",
                                o.lab, words);
  c->footer(
      "Slopes belong to straight lines through log(rmse), with standard errors from those of the points.");
  addResume(c, o.lab);
  addMeasured(c, o.selection);
  addFunctions(c, o.functions, "(cosine)");
  addProblem(c, o.problem, true);
  addPattern(c, o.pattern);
  c->add_option("--doublings", o.doublings, "the largest mean has 2^doublings estimates (10)")
      ->check(wholeNumber(1u, 24u));
  c->add_option("--trials", o.trials, "means of each size (256)")->check(wholeNumber(4ull, kMostTrials));
  runWhenChosen(c, run, o, runConverge);
}

void addProfile(CLI::App& app, ProfileOptions& o, const Words& words, Run& run) {
  CLI::App* c = addTableCommand(app, "profile", "Show a line: extinction, controls, points of one estimate",
                                o.lab, words);
  addMeasured(c, o.selection);
  addFunction(c, o.function);
  addProblem(c, o.problem, true);
  c->add_option("--points", o.points, "where the field is shown (256)")->check(wholeNumber(2u, 1000000u));
  c->add_option("--picture", o.picture, "image file to plot into: .png, .exr, .pfm or .tga");
  runWhenChosen(c, run, o, runProfile);
}

void addStress(CLI::App& app, StressOptions& o, const Words& words, Run& run) {
  CLI::App* c = addTableCommand(app, "stress", "Try estimators on stiff and extreme lines", o.lab, words);
  c->footer(
      "Verdicts: pass; expected (what the traits predict cannot work); undecided (too few trials for\n"
      "so rare events); skipped; fail. Every cell runs in a process of its own with a limit on processor\n"
      "time. Exit status 1 when any verdict is fail, or missing as the run was stopped. Seconds are those\n"
      "of all trials of a cell. The whole table: medialab stress -o stress.csv, some five minutes on two\n"
      "processors.");
  addMeasured(c, o.selection);
  c->add_option("--case", o.cases, "names of cases, or beginnings of names (all)")
      ->delimiter(',')
      ->take_all();
  c->add_flag("--quick", o.isQuick, "fewer cases and trials: seconds");
  runWhenChosen(c, run, o, runStress);
}

void addPrecision(CLI::App& app, LabOptions& o, const Words& words, Run& run) {
  CLI::App* c = addTableCommand(app, "precision", "Compare float with double where it matters", o, words);
  c->footer(
      "Runs ratio tracking, ray marching and 1 - T with positions, weights and sums in float and in\n"
      "double on the same random numbers.");
  runWhenChosen(c, run, o, runPrecision);
}

void addDocs(CLI::App& app, DocsOptions& o, const Words& words, Run& run) {
  CLI::App* c = app.add_subcommand("docs", "Write the page docs/estimators.md, with measured tables");
  addLabOptions(c, o.lab, words);
  c->add_option("-o,--outfile", o.lab.outfile, "file to write, .md (standard output)");
  c->add_option("--trials", o.trials, "of each measured cell (20000)")->check(wholeNumber(2ull, kMostTrials));
  runWhenChosen(c, run, o, runDocs);
}

}  // namespace

int medialabMain(int argc, char** argv) {
  CLI::App app{"Measures transmittance estimators on lines whose answers are known", "medialab"};
  app.require_subcommand(1);
  const Words words{commandText(argc, argv), identityText(argc, argv)};
  LineCommands lines;
  ListOptions list;
  EstimateOptions estimate;
  HeatmapWords heatmap;
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
  lines.addTo(app, words, run);
  addStress(app, stress, words, run);
  addPrecision(app, precision, words, run);
  addDocs(app, docs, words, run);
  return runTool(app, argc, argv, run);
}

}  // namespace pbrtmedia

int main(int argc, char** argv) { return pbrtmedia::medialabMain(argc, argv); }
