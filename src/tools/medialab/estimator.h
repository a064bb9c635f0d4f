// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "reciprocal/any_reciprocal.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// What estimators of the lab estimate of the optical depth F of a line.
enum class Quantity {
  Transmittance,  ///< g(F), g a law
  Reciprocal      ///< 1/F
};
std::string_view nameOf(Quantity quantity);
std::optional<Quantity> findQuantity(std::string_view name);
std::vector<std::string_view> quantityNames();
/// The keywords of the estimators of a quantity.
std::vector<std::string_view> estimatorNamesOf(Quantity quantity);

/// An estimator of transmittance or of the reciprocal, under a label of the user's.
class LabEstimator {
 public:
  /// The estimator called `name`, of either quantity, with its default parameters. Throws std::runtime_error,
  /// telling the nearest names, when there is none.
  explicit LabEstimator(std::string_view name);

  const std::string& label() const { return label_; }
  void relabel(std::string label) { label_ = std::move(label); }
  Quantity quantity() const;
  EstimatorTraits::Bias bias() const;
  std::vector<ParameterDescription> parameters() const;
  AssignResult setParameter(std::string_view name, const ParameterValue& value);

  /// Of one of transmittance only: std::bad_variant_access for others.
  EstimatorTraits traits() const { return traitsOf(std::get<AnyEstimator>(held_)); }
  /// Of one of reciprocals only, likewise.
  ReciprocalTraits reciprocalTraits() const { return traitsOf(std::get<AnyReciprocal>(held_)); }
  AnyLaw law() const { return lawOf(std::get<AnyEstimator>(held_)); }
  /// False, changing nothing, when it cannot serve the law; so always for a reciprocal.
  bool setLaw(const AnyLaw& law);

  const std::variant<AnyEstimator, AnyReciprocal>& held() const { return held_; }

 private:
  std::string label_;
  std::variant<AnyEstimator, AnyReciprocal> held_;
};

/// The quantity at an optical depth, under the estimator's law: infinite where a reciprocal has none.
double answerAt(const LabEstimator& estimator, double depth);
/// The depth at which the quantity is `answer`; infinite where a law never falls so low.
double depthOfAnswer(const LabEstimator& estimator, double answer);
/// The law with its parameters, "pinknoise correlation=0.5", or the reciprocal.
std::string describeQuantity(const LabEstimator& estimator);

}  // namespace pbrtmedia
