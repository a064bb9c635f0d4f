// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "transmittance/law.h"
#include "transmittance/parameters.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// One of AnyEstimator under a label of the user's. Stands before that type so that few files compile it; see
/// medialab_held_estimator.h.
class LabEstimator {
 public:
  struct Held;

  /// The keywords of all estimators, in the order of their list.
  static std::vector<std::string_view> names();
  /// The estimator called `name` with its default parameters. Throws std::runtime_error, telling the nearest
  /// names, when there is none.
  explicit LabEstimator(std::string_view name);
  LabEstimator(const LabEstimator& o);
  LabEstimator(LabEstimator&& o) noexcept;
  LabEstimator& operator=(LabEstimator o) noexcept;
  ~LabEstimator();

  const std::string& label() const { return label_; }
  void relabel(std::string label) { label_ = std::move(label); }
  EstimatorTraits traits() const;
  std::vector<ParameterDescription> parameters() const;
  AssignResult setParameter(std::string_view name, const ParameterValue& value);
  AnyLaw law() const;
  /// False, changing nothing, when it cannot serve the law.
  bool setLaw(const AnyLaw& law);
  const Held& held() const { return *held_; }

 private:
  std::string label_;
  std::unique_ptr<Held> held_;
};

}  // namespace pbrtmedia
