// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/selection.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "base/diagnostics.h"
#include "tools/medialab/tabulated.h"
#include "tools/medialab/volume_line.h"

namespace pbrtmedia {
namespace {

constexpr std::string_view kAll = "all";

struct Assignment {
  std::string name;
  ParameterValue value;
};

std::string inQuotes(std::string_view text) {
  std::string out = "\"";
  out += text;
  out += '"';
  return out;
}

Assignment parseAssignment(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos || equals + 1 == text.size()) {
    throw std::runtime_error("parameter " + inQuotes(text) + ": expected name=value");
  }
  const std::string_view word = text.substr(equals + 1);
  Assignment assignment{std::string(text.substr(0, equals)), std::string(word)};
  double number = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (status == std::errc() && end == word.data() + word.size()) {
    assignment.value = number;
  } else if (word == "true" || word == "false") {
    assignment.value = word == "true";
  }
  return assignment;
}

std::vector<std::string_view> namesOf(const std::vector<ParameterDescription>& parameters) {
  std::vector<std::string_view> names;
  for (const ParameterDescription& p : parameters) names.push_back(p.name);
  return names;
}

/// Of all quantities.
std::vector<std::string_view> everyName() {
  std::vector<std::string_view> names;
  for (const std::string_view quantity : quantityNames()) {
    for (const std::string_view name : estimatorNamesOf(*findQuantity(quantity))) names.push_back(name);
  }
  return names;
}

/// The estimators that have a parameter of this name.
std::vector<std::string_view> ownersOf(std::string_view parameter) {
  std::vector<std::string_view> owners;
  for (const std::string_view name : everyName()) {
    const auto parameters = LabEstimator(name).parameters();
    if (std::any_of(parameters.begin(), parameters.end(),
                    [&](const ParameterDescription& p) { return p.name == parameter; })) {
      owners.push_back(name);
    }
  }
  return owners;
}

AssignResult assignTo(LabEstimator& estimator, const Assignment& a) {
  return estimator.setParameter(a.name, a.value);
}
AssignResult assignTo(AnyLaw& law, const Assignment& a) { return setParameter(law, a.name, a.value); }

/// Sets a parameter; false when there is none of that name.
template <class Owner>
bool setIfKnown(Owner& owner, std::string_view ownerName, const Assignment& assignment) {
  const AssignResult result = assignTo(owner, assignment);
  if (result.error) {
    throw std::runtime_error(std::string(ownerName) + ": parameter " + inQuotes(assignment.name) + ": " +
                             *result.error);
  }
  return result.known;
}

[[noreturn]] void complainUnknown(std::string_view estimator, std::string_view parameter,
                                  const std::vector<ParameterDescription>& known) {
  std::string text(estimator);
  text += " has no parameter " + inQuotes(parameter);
  if (known.empty()) text += "; it has none at all";
  const std::vector<std::string_view> names = namesOf(known);
  text += suggestion(parameter, names);
  if (const auto owners = ownersOf(parameter); !owners.empty()) {
    text += "; estimators that have it: " + joined(owners);
  }
  throw std::runtime_error(text);
}

LabEstimator parseEstimator(const std::string& word) {
  const std::size_t colon = word.find(':');
  const std::string name = word.substr(0, colon);
  LabEstimator estimator(name);
  for (std::size_t begin = colon; begin != std::string::npos;) {
    const std::size_t end = word.find(':', begin + 1);
    const std::size_t length = end == std::string::npos ? end : end - begin - 1;
    const Assignment assignment = parseAssignment(std::string_view(word).substr(begin + 1, length));
    if (!setIfKnown(estimator, name, assignment)) {
      complainUnknown(name, assignment.name, estimator.parameters());
    }
    begin = end;
  }
  estimator.relabel(word);
  return estimator;
}

AnyLaw parseLaw(const std::string& name) {
  const auto law = findLaw(name);
  if (law) return *law;
  const auto names = lawNames();
  throw std::runtime_error("unknown law " + inQuotes(name) + suggestion(name, names));
}

/// All parameter names of all estimators.
std::vector<std::string> everyParameter() {
  std::vector<std::string> all;
  for (const std::string_view name : everyName()) {
    for (const ParameterDescription& p : LabEstimator(name).parameters()) all.push_back(p.name);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Values of different quantities have nothing to do with each other.
void requireOneQuantity(const std::vector<LabEstimator>& chosen, const std::optional<Quantity>& wanted) {
  for (const LabEstimator& one : chosen) {
    const std::string own(nameOf(one.quantity()));
    if (wanted && one.quantity() != *wanted) {
      throw std::runtime_error(one.label() + " estimates the " + own + ", found --quantity " +
                               std::string(nameOf(*wanted)));
    }
    if (one.quantity() != chosen.front().quantity()) {
      throw std::runtime_error("estimators of different quantities: " + chosen.front().label() +
                               " estimates the " + std::string(nameOf(chosen.front().quantity())) + ", " +
                               one.label() + " the " + own);
    }
  }
}

}  // namespace

std::string joined(const std::vector<std::string_view>& words) {
  std::string out;
  for (const std::string_view word : words) {
    if (!out.empty()) out += ", ";
    out += word;
  }
  return out;
}

bool EstimatorSelection::isAll() const {
  return std::find(estimators.begin(), estimators.end(), kAll) != estimators.end();
}

std::vector<LabEstimator> EstimatorSelection::select(std::vector<LabTable::Skipped>& skipped) const {
  const bool isAll = this->isAll();
  std::vector<LabEstimator> chosen;
  if (isAll) {
    if (estimators.size() > 1) throw std::runtime_error("\"all\" stands for every estimator: name no other");
    for (const std::string_view name : estimatorNamesOf(quantity.value_or(Quantity::Transmittance))) {
      chosen.emplace_back(name);
    }
  } else {
    for (const std::string& word : estimators) chosen.push_back(parseEstimator(word));
  }
  requireOneQuantity(chosen, quantity);
  std::optional<AnyLaw> chosenLaw;
  if (!law.empty()) chosenLaw = parseLaw(law);
  for (const std::string& text : params) {
    const Assignment assignment = parseAssignment(text);
    const bool lawKnows = chosenLaw && setIfKnown(*chosenLaw, nameOf(*chosenLaw), assignment);
    bool anyKnows = lawKnows;
    for (LabEstimator& one : chosen) {
      const bool knows = setIfKnown(one, one.label(), assignment);
      anyKnows = anyKnows || knows;
      if (!knows && !lawKnows && !isAll) {
        complainUnknown(one.label(), assignment.name, one.parameters());
      }
    }
    if (!anyKnows) {
      const std::vector<std::string> all = everyParameter();
      const std::vector<std::string_view> views(all.begin(), all.end());
      throw std::runtime_error("no estimator has a parameter " + inQuotes(assignment.name) +
                               suggestion(assignment.name, views));
    }
  }
  if (chosenLaw && !chosen.empty() && chosen.front().quantity() != Quantity::Transmittance) {
    throw std::runtime_error("a law turns depth into transmittance: --law " + law +
                             " has nothing to say of the " + std::string(nameOf(chosen.front().quantity())));
  }
  if (chosenLaw) {
    std::erase_if(chosen, [&](LabEstimator& one) {
      if (one.setLaw(*chosenLaw)) return false;
      const std::string reason = "serves no law but " + joined(one.traits().laws.names());
      if (!isAll) throw std::runtime_error(one.label() + " cannot serve the law " + law + ": it " + reason);
      skipped.push_back({one.label(), reason});
      return true;
    });
  }
  return chosen;
}

void noteQuantity(LabTable& table, const std::vector<LabEstimator>& estimators) {
  if (estimators.empty() || estimators.front().quantity() == Quantity::Transmittance) return;
  table.note("quantity: " + std::string(nameOf(estimators.front().quantity())) + ", 1 / depth");
}

std::vector<CanonicalFunction> FunctionSelection::select() const {
  std::vector<CanonicalFunction> functions;
  const auto names = canonicalFunctionNames();
  bool hasVolume = false;
  for (const std::string& word : words) {
    const std::filesystem::path path(word);
    if (path.extension() == ".csv" || path.extension() == ".txt") {
      functions.push_back(readTabulatedFunction(path));
    } else if (path.extension() == ".nvdb") {
      hasVolume = true;
      if (ray.size() != 6) {
        throw std::runtime_error(inQuotes(word) + " needs --ray with six numbers: origin, direction; found " +
                                 std::to_string(ray.size()));
      }
      functions.push_back(
          functionAlong(path, grid, {.o = {ray[0], ray[1], ray[2]}, .d = {ray[3], ray[4], ray[5]}}));
    } else if (word == kAll) {
      for (const std::string_view name : names) functions.push_back(*findCanonicalFunction(name));
    } else if (auto function = findCanonicalFunction(word)) {
      functions.push_back(std::move(*function));
    } else {
      throw std::runtime_error("unknown extinction function " + inQuotes(word) + suggestion(word, names) +
                               "; or a table (.csv), or a volume (.nvdb) with --ray");
    }
  }
  if (!hasVolume && (!ray.empty() || !grid.empty()))
    throw std::runtime_error("--ray and --grid belong to a volume, found no --extinction file.nvdb");
  return functions;
}

}  // namespace pbrtmedia
