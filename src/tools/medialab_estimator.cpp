// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab_estimator.h"

#include <stdexcept>
#include <utility>

#include "base/diagnostics.h"
#include "tools/medialab_held_estimator.h"

namespace pbrtmedia {

std::vector<std::string_view> LabEstimator::names() { return estimatorNames(); }

LabEstimator::LabEstimator(std::string_view name) : label_(name) {
  auto found = findEstimator(name);
  if (!found) {
    std::string text = "unknown estimator \"";
    text += name;
    text += '"';
    throw std::runtime_error(text + suggestion(name, names()));
  }
  held_ = std::make_unique<Held>(Held{*std::move(found)});
}

LabEstimator::LabEstimator(const LabEstimator& o)
    : label_(o.label_), held_(std::make_unique<Held>(*o.held_)) {}
LabEstimator::LabEstimator(LabEstimator&& o) noexcept = default;
LabEstimator& LabEstimator::operator=(LabEstimator o) noexcept {
  std::swap(label_, o.label_);
  std::swap(held_, o.held_);
  return *this;
}
LabEstimator::~LabEstimator() = default;

EstimatorTraits LabEstimator::traits() const { return traitsOf(held_->estimator); }
std::vector<ParameterDescription> LabEstimator::parameters() const { return parametersOf(held_->estimator); }
AssignResult LabEstimator::setParameter(std::string_view name, const ParameterValue& value) {
  return pbrtmedia::setParameter(held_->estimator, name, value);
}
AnyLaw LabEstimator::law() const { return lawOf(held_->estimator); }
bool LabEstimator::setLaw(const AnyLaw& law) { return pbrtmedia::setLaw(held_->estimator, law); }

}  // namespace pbrtmedia
