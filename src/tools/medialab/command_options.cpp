// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/command_options.h"

#include <map>

#include "tools/command_line.h"

namespace pbrtmedia {
namespace {

constexpr unsigned kMostThreads = 4096;

void addTableOptions(CLI::App* c, LabOptions& o) {
  c->add_option("-o,--outfile", o.outfile, "file to write, .csv, .json or .txt (standard output)");
  std::map<std::string, TableFormat> formats;
  for (const auto& [name, format] : kTableFormats) formats.emplace(name, format);
  c->add_option("--format", o.format,
                "csv, json or text (as the file's name ends; without a file text on a terminal, else csv)")
      ->transform(oneOf(formats))
      ->type_name("NAME");
}

}  // namespace

CLI::App* addTableCommand(CLI::App& app, const char* name, const char* about, LabOptions& o,
                          const Words& words) {
  CLI::App* const c = app.add_subcommand(name, about);
  addLabOptions(c, o, words);
  addTableOptions(c, o);
  return c;
}

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

void addMeasured(CLI::App* c, EstimatorSelection& o) {
  addSelection(c, o);
  std::map<std::string, Quantity> names;
  for (const std::string_view name : quantityNames()) names.emplace(name, *findQuantity(name));
  c->add_option(
       "--quantity", o.quantity,
       "what is estimated of the optical depth: transmittance, or reciprocal (1 / depth) (that of the "
       "estimators named; of all: transmittance)")
      ->transform(oneOf(names))
      ->type_name("NAME");
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
  CLI::Option* lower = c->add_option("--lower", o.lowers, "lower control / smallest density (0: none)")
                           ->delimiter(',')
                           ->take_all()
                           ->check(number(NumberRange::atLeast(0)));
  c->add_option(
       "--lower-depth", o.lowerDepths,
       "instead of --lower: optical depth of a constant lower control, for functions that touch 0 too; "
       "where it is above the extinction it is no bound")
      ->delimiter(',')
      ->take_all()
      ->check(number(NumberRange::atLeast(0)))
      ->excludes(lower);
  c->add_option("--supervoxels", o.superVoxels, "intervals with controls of their own (1)")
      ->check(wholeNumber(1u, ProblemOptions::kMostSuperVoxels));
  c->add_option("--length", o.length, "of the segment (the width of the function, mostly 1)")
      ->check(number(NumberRange::above(0)));
  c->add_option("--offset", o.offset, "of the segment's start (0)")->check(number(NumberRange::any()));
  c->add_flag("--paper-depth", o.isPaperDepth,
              "a depth is the papers' factor of the formula, not the true depth; they differ for cosine");
  c->add_flag("--no-means", o.noMeans, "intervals do not know their mean density");
}

namespace {

void addVolumes(CLI::App* c, FunctionSelection& o) {
  c->add_option("--ray", o.ray, "through an .nvdb file, in its world space: ox oy oz dx dy dz")
      ->expected(6)
      ->check(number(NumberRange::any()));
  c->add_option("--grid", o.grid, "of an .nvdb file with several: name, number or beginning of a name");
}

}  // namespace

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

void addPlan(CLI::App* c, TrialPlan& plan) {
  addPattern(c, plan.pattern);
  c->add_option("--samples-per-estimate", plan.samples, "estimates averaged by a trial (1)")
      ->check(wholeNumber(1u, kMostSamples));
}

}  // namespace pbrtmedia
