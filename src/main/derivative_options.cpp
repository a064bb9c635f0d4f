// SPDX-License-Identifier: BSD-2-Clause
#include "main/derivative_options.h"

#include <map>
#include <string>

#include "main/option_values.h"
#include "tools/command_line.h"

namespace pbrtmedia {
namespace {

constexpr const char* kDerivatives = "Derivatives";

}  // namespace

void addDerivativeOptions(CLI::App& app, DerivativeOptions& options) {
  using Difference = DifferenceSchedule::Difference;
  using Debias = DifferenceSchedule::Debias;
  DifferenceSchedule::Params& difference = options.difference;
  CLI::Option* const name =
      app.add_option("--derivative", options.variable,
                     "render how the image changes with $NAME, from differences (docs/derivatives.md)")
          ->check(variableName())
          ->type_name("NAME")
          ->group(kDerivatives);
  CLI::Option* const step =
      app.add_option("--step", difference.step, "of the variable, between two images; of either sign")
          ->check(number(NumberRange::any()))
          ->type_name("H")
          ->group(kDerivatives);
  name->needs(step);
  step->needs(name);
  const std::map<std::string, Difference> differences = {{"forward", Difference::Forward},
                                                         {"central", Difference::Central}};
  app.add_option("--difference", difference.difference,
                 "forward (default): from the value to a step above; central: from a step below")
      ->transform(oneOf(differences))
      ->needs(name)
      ->type_name("KIND")
      ->group(kDerivatives);
  const std::map<std::string, Debias> debiased = {
      {"none", Debias::None}, {"single", Debias::Single}, {"progressive", Debias::Progressive}};
  app.add_option("--debias", difference.debias,
                 "none (default): one step for all passes; single: each pass corrects it by a level drawn, "
                 "without bias; progressive: steps shrink from pass to pass")
      ->transform(oneOf(debiased))
      ->needs(name)
      ->type_name("HOW")
      ->group(kDerivatives);
  app.add_option("--step-decay", difference.decay, "the step of progressive pass k is H k^-D (default 1/3)")
      ->needs(name)
      ->check(number({.least = 0, .most = 1, .excludesLeast = true}))
      ->type_name("D")
      ->group(kDerivatives);
  app.add_option("--pass-samples", options.samplesPerPass,
                 "samples per pixel of a pass, which share step and level (default 1/64 of all, 1 to 16)")
      ->needs(name)
      ->check(wholeNumber(1, 1 << 20))
      ->type_name("N")
      ->group(kDerivatives);
}

}  // namespace pbrtmedia
