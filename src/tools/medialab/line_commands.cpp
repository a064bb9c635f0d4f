// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/line_commands.h"

#include <map>

#include "tools/command_line.h"

namespace pbrtmedia {
namespace {

void addLevels(CLI::App& app, LevelsOptions& o, const Words& words, Run& run) {
  CLI::App* c = addTableCommand(
      app, "levels", "Measure the corrections of a debiased estimator, level by level", o.lab, words);
  c->footer(
      "Mean, variance and look-ups of one correction of each level, under two couplings: the two marches of\n"
      "the coarse level are halves of the fine one (split, as the estimators have it), or one of its own\n"
      "(independent). second_moment_share is what the level adds to the second moment of the single-term\n"
      "estimate, lookups_share what it adds to its mean look-ups: where the one grows with the level, or "
      "the\n"
      "other, variance or cost is infinite.");
  c->add_option(
       "--estimator", o.selection.estimators,
       "debiased-ray-marching, prefix-debiased-ray-marching or reciprocal-telescoping, with parameters "
       "(debiased-ray-marching)")
      ->delimiter(',')
      ->take_all();
  c->add_option("--law", o.selection.law, "transmittance law (exponential)");
  c->add_option("--param", o.selection.params, "name=value of the law and of every estimator chosen");
  addFunctions(c, o.functions, "(cosine)");
  addProblem(c, o.problem, true);
  c->add_option("--levels", o.levels, "levels from the estimator's own coarse one on (8)")
      ->check(wholeNumber(1u, LevelsOptions::kMostLevels));
  c->add_option("--trials", o.trials, "of each row (10000)")->check(wholeNumber(4ull, kMostTrials));
  runWhenChosen(c, run, o, runLevels);
}

void addRunning(CLI::App& app, RunningOptions& o, const Words& words, Run& run) {
  CLI::App* c = addTableCommand(app, "running", "Show estimates as they grow along a line", o.lab, words);
  c->footer(
      "The estimate of the line cut at s, from the same random numbers for all s: the running weight of\n"
      "estimators that walk (ratio, residual-ratio, adaptive-ratio, track-length, next-flight); others "
      "choose\n"
      "their points anew for each s. Rows with the number of a run hold its value; \"mean\" and \"stderr\" "
      "are\n"
      "those of all runs, \"exact\" is the answer.");
  addMeasured(c, o.selection);
  addFunction(c, o.function);
  addProblem(c, o.problem, true);
  c->add_option("--to", o.to, "end of the part of the line that is shown (the line's)")
      ->check(number(NumberRange::above(0)));
  c->add_option("--points", o.points, "where values are shown, evenly spaced (200)")
      ->check(wholeNumber(1u, 100000u));
  c->add_option("--runs", o.runs, "that the mean is taken over (1000)")->check(wholeNumber(2u, 1u << 24));
  c->add_option("--curves", o.curves, "runs that are shown one by one (100)")
      ->check(wholeNumber(0u, 1u << 24));
  runWhenChosen(c, run, o, runRunning);
}

void addPowerLaw(CLI::App& app, PowerLawOptions& o, const Words& words, Run& run) {
  CLI::App* c =
      addTableCommand(app, "power-law", "Measure Monte Carlo means of x^-alpha on (0, 1)", o.lab, words);
  c->footer(
      "How fast means converge whose variance is infinite: it is finite below alpha = 1/2 only, and the "
      "error\n"
      "falls like samples^-(1 - alpha) above. error is the mean of |mean of n samples / exact - 1| over "
      "trials.\n"
      "The slope is fitted to the larger half of the sizes.");
  c->add_option("--alpha", o.alphas, "exponents, 0 to 1 (0.4,0.6,0.8,0.9)")
      ->delimiter(',')
      ->take_all()
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--doublings", o.doublings, "the largest mean has 2^doublings samples (14)")
      ->check(wholeNumber(2u, PowerLawOptions::kMostDoublings));
  c->add_option("--trials", o.trials, "of each alpha (1000)")->check(wholeNumber(4ull, kMostTrials));
  runWhenChosen(c, run, o, runPowerLaw);
}

void addProgressive(CLI::App& app, ProgressiveOptions& o, const Words& words, Run& run) {
  CLI::App* c =
      addTableCommand(app, "progressive", "Average passes under upper controls that rise", o.lab, words);
  c->footer(
      "Every pass makes --per-pass estimates under the controls as the pass before has left them, and all\n"
      "passes so far are averaged; --repeats such sequences tell mean and mean square error. Controls begin "
      "at\n"
      "--start everywhere. Update \"learned\": a look-up above control - epsilon raises the control of its\n"
      "interval, from the next pass on, to density + epsilon; \"rising\": all rise by --rise, up to --most.\n"
      "Densities are cut to the controls unless --unclamped. Extinctions, not densities, all of them.");
  addSelection(c, o.selection);
  addFunction(c, o.function);
  c->add_option("--depth", o.problem.depths, "optical depth (1)")
      ->expected(1)
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--supervoxels", o.problem.superVoxels, "intervals with controls of their own (80)")
      ->check(wholeNumber(1u, ProblemOptions::kMostSuperVoxels));
  c->add_option("--length", o.problem.length, "of the segment (the width of the function, mostly 1)")
      ->check(number(NumberRange::above(0)));
  c->add_option("--passes", o.passes, "of a sequence (64)")->check(wholeNumber(1u, 1u << 20));
  c->add_option("--per-pass", o.perPass, "estimates of one pass (1)")->check(wholeNumber(1u, 1u << 20));
  c->add_option("--repeats", o.repeats, "sequences (256)")->check(wholeNumber(2u, 1u << 24));
  c->add_option("--start", o.start, "upper control before the first pass (0.01)")
      ->check(number(NumberRange::above(0)));
  const std::map<std::string, BoundsUpdate> updates{{"learned", BoundsUpdate::Learned},
                                                    {"rising", BoundsUpdate::Rising}};
  c->add_option("--update", o.update, "of the controls between passes: learned or rising (learned)")
      ->transform(oneOf(updates))
      ->type_name("NAME");
  c->add_option("--epsilon", o.epsilon, "learned: what a control keeps above the densities found (0.2)")
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--rise", o.rise, "rising: what controls rise by in a pass (0.5)")
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--most", o.most, "rising: the largest control (20)")->check(number(NumberRange::above(0)));
  c->add_flag("--unclamped", o.isUnclamped, "densities are not cut to the controls");
  runWhenChosen(c, run, o, runProgressive);
}

}  // namespace

void LineCommands::addTo(CLI::App& app, const Words& words, Run& run) {
  addLevels(app, levels_, words, run);
  addRunning(app, running_, words, run);
  addPowerLaw(app, powerLaw_, words, run);
  addProgressive(app, progressive_, words, run);
}

}  // namespace pbrtmedia
