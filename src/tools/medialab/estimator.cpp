// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/estimator.h"

#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/diagnostics.h"

namespace pbrtmedia {
namespace {

constexpr std::array kQuantityNames{std::string_view("transmittance"), std::string_view("reciprocal")};

}  // namespace

std::string_view nameOf(Quantity quantity) { return kQuantityNames[static_cast<std::size_t>(quantity)]; }
std::vector<std::string_view> quantityNames() { return {kQuantityNames.begin(), kQuantityNames.end()}; }
std::optional<Quantity> findQuantity(std::string_view name) {
  for (std::size_t i = 0; i < kQuantityNames.size(); ++i) {
    if (kQuantityNames[i] == name) return static_cast<Quantity>(i);
  }
  return std::nullopt;
}
std::vector<std::string_view> estimatorNamesOf(Quantity quantity) {
  return quantity == Quantity::Transmittance ? estimatorNames() : reciprocalNames();
}

LabEstimator::LabEstimator(std::string_view name) : label_(name) {
  if (auto found = findEstimator(name)) {
    held_ = *std::move(found);
    return;
  }
  if (auto found = findReciprocal(name)) {
    held_ = *std::move(found);
    return;
  }
  std::string text = "unknown estimator \"";
  text += name;
  text += '"';
  std::vector<std::string_view> names = estimatorNames();
  for (const std::string_view other : reciprocalNames()) names.push_back(other);
  throw std::runtime_error(text + suggestion(name, names));
}

Quantity LabEstimator::quantity() const {
  return std::holds_alternative<AnyEstimator>(held_) ? Quantity::Transmittance : Quantity::Reciprocal;
}
EstimatorTraits::Bias LabEstimator::bias() const {
  return std::visit([](const auto& any) { return traitsOf(any).bias; }, held_);
}
std::vector<ParameterDescription> LabEstimator::parameters() const {
  return std::visit([](const auto& any) { return parametersOf(any); }, held_);
}
AssignResult LabEstimator::setParameter(std::string_view name, const ParameterValue& value) {
  return std::visit([&](auto& any) { return pbrtmedia::setParameter(any, name, value); }, held_);
}
bool LabEstimator::setLaw(const AnyLaw& law) {
  AnyEstimator* const estimator = std::get_if<AnyEstimator>(&held_);
  return estimator != nullptr && pbrtmedia::setLaw(*estimator, law);
}

double answerAt(const LabEstimator& estimator, double depth) {
  if (estimator.quantity() == Quantity::Transmittance) return transmittanceOf(estimator.law(), depth);
  return depth > 0 ? 1 / depth : std::numeric_limits<double>::infinity();
}

double depthOfAnswer(const LabEstimator& estimator, double answer) {
  if (estimator.quantity() == Quantity::Transmittance) return depthReachedOf(estimator.law(), answer);
  return 1 / answer;
}

std::string describeQuantity(const LabEstimator& estimator) {
  if (estimator.quantity() == Quantity::Reciprocal) return std::string(nameOf(Quantity::Reciprocal));
  const AnyLaw law = estimator.law();
  std::string text(nameOf(law));
  for (const ParameterDescription& p : parametersOf(law)) text += ' ' + p.name + '=' + p.value;
  return text;
}

}  // namespace pbrtmedia
