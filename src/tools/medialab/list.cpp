// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/list.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "fields/canonical_function.h"
#include "freeflight/any_flight.h"
#include "reciprocal/any_reciprocal.h"
#include "tools/medialab/estimator.h"
#include "transmittance/sampling_pattern.h"

namespace pbrtmedia {
namespace {

using Json = nlohmann::ordered_json;

Json parametersJson(const std::vector<ParameterDescription>& parameters) {
  Json all = Json::array();
  for (const ParameterDescription& p : parameters) {
    all.push_back(
        {{"name", p.name}, {"type", p.type}, {"default", p.value}, {"allowed", p.allowed}, {"help", p.help}});
  }
  return all;
}

/// What the traits of estimators, reciprocals and flights all say.
template <class Traits>
Json traitsJson(std::string_view name, const Traits& t) {
  return {{"name", name},         {"summary", t.summary},   {"source", t.source},
          {"useWhen", t.useWhen}, {"bias", nameOf(t.bias)}, {"biasNote", t.biasNote}};
}

Json estimatorJson(std::string_view name) {
  const LabEstimator estimator(name);
  const EstimatorTraits t = estimator.traits();
  Json all = traitsJson(name, t);
  all["mayLeaveUnitInterval"] = t.mayLeaveUnitInterval;
  all["control"] = nameOf(t.control);
  all["finiteVariance"] = t.finiteVariance;
  all["finiteVarianceUnbounded"] = t.finiteVarianceUnbounded;
  all["boundedCost"] = t.boundedCost;
  all["tellsSpread"] = t.tellsSpread;
  all["laws"] = t.laws.names();
  all["parameters"] = parametersJson(estimator.parameters());
  return all;
}

Json reciprocalJson(std::string_view name) {
  const AnyReciprocal estimator = *findReciprocal(name);
  const ReciprocalTraits t = traitsOf(estimator);
  Json all = traitsJson(name, t);
  all["domain"] = t.domain;
  all["control"] = nameOf(t.control);
  all["needsPositiveDensity"] = t.needsPositiveDensity;
  all["finiteVariance"] = t.finiteVariance;
  all["varianceNote"] = t.varianceNote;
  all["cost"] = t.cost;
  all["boundedCost"] = t.boundedCost;
  all["parameters"] = parametersJson(parametersOf(estimator));
  return all;
}

Json flightJson(std::string_view name) {
  const AnyFlight flight = *findFlight(name);
  const FlightTraits t = traitsOf(flight);
  Json all = traitsJson(name, t);
  all["control"] = nameOf(t.control);
  all["unitWeights"] = t.unitWeights;
  all["mayBeNegative"] = t.mayBeNegative;
  all["laws"] = t.laws.names();
  all["parameters"] = parametersJson(parametersOf(flight));
  return all;
}

Json functionJson(std::string_view name) {
  const CanonicalFunction f = *findCanonicalFunction(name);
  const CanonicalFunction::Range range = f.range();
  return {{"name", name},
          {"formula", f.about().formula},
          {"source", f.about().source},
          {"width", f.width()},
          {"integral", f.integral()},
          {"max", range.max},
          {"min", range.min},
          {"tightRatio", f.integral() / (f.width() * range.max)},
          {"piecewisePolynomial", f.isPiecewisePolynomial()}};
}

Json lawJson(std::string_view name) {
  const AnyLaw law = *findLaw(name);
  return {{"name", name},
          {"formula", std::visit([](const auto& held) { return std::string_view(held.kFormula); }, law)},
          {"parameters", parametersJson(parametersOf(law))}};
}

Json listJson(const std::string& what) {
  Json list = Json::object();
  const auto wants = [&](const char* kind) { return what == "all" || what == kind; };
  if (wants("estimators")) {
    list["estimators"] = Json::array();
    for (const std::string_view name : estimatorNames()) list["estimators"].push_back(estimatorJson(name));
  }
  if (wants("reciprocals")) {
    list["reciprocals"] = Json::array();
    for (const std::string_view name : reciprocalNames()) list["reciprocals"].push_back(reciprocalJson(name));
  }
  if (wants("flights")) {
    list["flights"] = Json::array();
    for (const std::string_view name : flightNames()) list["flights"].push_back(flightJson(name));
  }
  if (wants("functions")) {
    list["functions"] = Json::array();
    for (const auto name : canonicalFunctionNames()) list["functions"].push_back(functionJson(name));
  }
  if (wants("laws")) {
    list["laws"] = Json::array();
    for (const std::string_view name : lawNames()) list["laws"].push_back(lawJson(name));
  }
  if (wants("patterns")) list["patterns"] = kPatternNames;
  return list;
}

std::string_view text(const Json& value) { return value.get_ref<const std::string&>(); }

void printParameters(const Json& parameters) {
  for (const Json& p : parameters) {
    std::cout << "      " << text(p["name"]) << " = " << text(p["default"]) << "  (" << text(p["type"]);
    if (!text(p["allowed"]).empty()) std::cout << ", " << text(p["allowed"]);
    std::cout << ") " << text(p["help"]) << '\n';
  }
}

void printTraits(const Json& e) {
  std::cout << "  " << text(e["name"]) << '\n'
            << "      " << text(e["summary"]) << "; " << text(e["source"]) << '\n'
            << "      use when " << text(e["useWhen"]) << '\n'
            << "      " << text(e["bias"]);
  if (!text(e["biasNote"]).empty()) std::cout << " (" << text(e["biasNote"]) << ')';
}

void printEstimator(const Json& e) {
  printTraits(e);
  std::cout << "; control: " << text(e["control"])
            << (e["mayLeaveUnitInterval"].get<bool>() ? "; may leave [0, 1]" : "; stays in [0, 1]")
            << (e["finiteVariance"].get<bool>() ? "; finite" : "; infinite") << " variance, "
            << (e["finiteVarianceUnbounded"].get<bool>() ? "finite" : "infinite") << " under a low control; "
            << (e["boundedCost"].get<bool>() ? "bounded" : "unbounded") << " cost; laws:";
  for (const Json& law : e["laws"]) std::cout << ' ' << text(law);
  std::cout << '\n';
  printParameters(e["parameters"]);
}

void printReciprocal(const Json& e) {
  printTraits(e);
  std::cout << " on " << text(e["domain"]) << "; control: " << text(e["control"]) << '\n'
            << "      variance: " << (e["finiteVariance"].get<bool>() ? "finite" : "may be infinite");
  if (!text(e["varianceNote"]).empty()) std::cout << ", " << text(e["varianceNote"]);
  std::cout << "; look-ups: " << text(e["cost"])
            << (e["boundedCost"].get<bool>() ? ", bounded" : ", unbounded") << '\n';
  printParameters(e["parameters"]);
}

void printFlight(const Json& e) {
  printTraits(e);
  std::cout << "; control: " << text(e["control"]) << "; weights "
            << (e["unitWeights"].get<bool>()     ? "1"
                : e["mayBeNegative"].get<bool>() ? "of any sign"
                                                 : "positive")
            << "; laws:";
  for (const Json& law : e["laws"]) std::cout << ' ' << text(law);
  std::cout << '\n';
  printParameters(e["parameters"]);
}

void printList(const Json& list) {
  if (list.contains("estimators")) {
    std::cout << "estimators\n";
    for (const Json& e : list["estimators"]) printEstimator(e);
  }
  if (list.contains("reciprocals")) {
    std::cout << "reciprocals\n";
    for (const Json& e : list["reciprocals"]) printReciprocal(e);
  }
  if (list.contains("flights")) {
    std::cout << "free flights\n";
    for (const Json& e : list["flights"]) printFlight(e);
  }
  if (list.contains("functions")) {
    std::cout << "functions\n";
    for (const Json& f : list["functions"]) {
      std::cout << "  " << text(f["name"]) << ": " << text(f["formula"]) << " on [0, " << f["width"]
                << "]; integral " << f["integral"] << ", max " << f["max"] << ", min " << f["min"] << "; "
                << text(f["source"]) << '\n';
    }
  }
  if (list.contains("laws")) {
    std::cout << "laws\n";
    for (const Json& law : list["laws"]) {
      std::cout << "  " << text(law["name"]) << ": " << text(law["formula"]) << '\n';
      printParameters(law["parameters"]);
    }
  }
  if (list.contains("patterns")) {
    std::cout << "patterns\n ";
    for (const Json& pattern : list["patterns"]) std::cout << ' ' << text(pattern);
    std::cout << '\n';
  }
}

}  // namespace

int runList(const ListOptions& options) {
  const Json list = listJson(options.what);
  if (options.json) {
    std::cout << list.dump(1) << '\n';
  } else {
    printList(list);
  }
  return 0;
}

}  // namespace pbrtmedia
