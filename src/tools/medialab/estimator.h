// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// A transmittance estimator under a label of the user's.
class LabEstimator {
 public:
  /// The estimator called `name` with its default parameters. Throws std::runtime_error, telling the nearest
  /// names, when there is none.
  explicit LabEstimator(std::string_view name);

  const std::string& label() const { return label_; }
  void relabel(std::string label) { label_ = std::move(label); }
  EstimatorTraits traits() const { return traitsOf(estimator_); }
  std::vector<ParameterDescription> parameters() const { return parametersOf(estimator_); }
  AssignResult setParameter(std::string_view name, const ParameterValue& value) {
    return pbrtmedia::setParameter(estimator_, name, value);
  }
  AnyLaw law() const { return lawOf(estimator_); }
  /// False, changing nothing, when it cannot serve the law.
  bool setLaw(const AnyLaw& law) { return pbrtmedia::setLaw(estimator_, law); }
  const AnyEstimator& held() const { return estimator_; }

 private:
  std::string label_;
  AnyEstimator estimator_;
};

}  // namespace pbrtmedia
