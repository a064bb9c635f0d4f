// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/docs_lists.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "freeflight/any_flight.h"
#include "reciprocal/any_reciprocal.h"
#include "tools/medialab/estimator.h"
#include "tools/medialab/selection.h"
#include "transmittance/law.h"

namespace pbrtmedia {
namespace {

void printParameters(std::ostream& out, const std::vector<ParameterDescription>& parameters) {
  if (parameters.empty()) return;
  out << "\n| parameter | type | default | allowed | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const ParameterDescription& p : parameters) {
    out << "| `" << p.name << "` | " << p.type << " | " << p.value << " | " << p.allowed << " | " << p.help
        << " |\n";
  }
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

void printEstimatorTable(std::ostream& out) {
  out << "| estimator | bias | control | in [0, 1] | finite variance | bounded cost | laws |\n"
         "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::string_view name : estimatorNames()) {
    const EstimatorTraits t = LabEstimator(name).traits();
    const bool servesAll = t.laws == LawSet::all();
    out << "| [`" << name << "`](#" << name << ") | " << nameOf(t.bias) << " | " << nameOf(t.control) << " | "
        << (t.mayLeaveUnitInterval ? "no" : "yes") << " | " << (t.finiteVariance ? "yes" : "no") << " | "
        << (t.boundedCost ? "yes" : "no") << " | " << (servesAll ? "all" : joined(t.laws.names())) << " |\n";
  }
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

}  // namespace

void printLists(std::ostream& out) {
  printEstimatorTable(out);
  out << "\n## Estimators\n";
  for (const std::string_view name : estimatorNames()) printEstimator(out, name);
  printLaws(out);
  printFlights(out);
  printReciprocals(out);
}

}  // namespace pbrtmedia
