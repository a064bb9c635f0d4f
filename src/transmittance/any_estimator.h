// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/parameters.h"
#include "transmittance/law.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// One of the transmittance estimators with its parameters. Knows none of their code, so that who chooses,
/// holds and describes estimators does not compile them; transmittance/estimator_list.h does. A value: copies
/// share until one is changed.
class AnyEstimator {
 public:
  struct Held;

  /// The first of the list.
  AnyEstimator();
  /// Of transmittance/estimator_list.h.
  template <class Estimator>
  requires requires { Estimator::kName; }
  AnyEstimator(const Estimator& estimator);
  explicit AnyEstimator(std::shared_ptr<const Held> held) : held_(std::move(held)) {}

  const Held& held() const { return *held_; }

 private:
  std::shared_ptr<const Held> held_;
};

/// The keyword of an estimator.
std::string_view nameOf(const AnyEstimator& estimator);
/// The estimator called `name`, with its default parameters; nothing when there is none.
std::optional<AnyEstimator> findEstimator(std::string_view name);
/// All keywords, default first.
std::vector<std::string_view> estimatorNames();

EstimatorTraits traitsOf(const AnyEstimator& estimator);
std::vector<ParameterDescription> parametersOf(const AnyEstimator& estimator);
AssignResult setParameter(AnyEstimator& estimator, std::string_view name, const ParameterValue& value);
/// The law it works under now.
AnyLaw lawOf(const AnyEstimator& estimator);
/// Puts the estimator under a law; false, changing nothing, when it cannot serve that one.
bool setLaw(AnyEstimator& estimator, const AnyLaw& law);

/// What estimates where light collides instead of what gets through.
struct CollisionEstimator {
  AnyEstimator estimator;
  double depthScale = 1;  ///< of the extinction it has to be asked with
};
/// Its estimates of -g'(F) / -g'(0), g the law of `estimator`, are biased as those of g are. In vacuum 1.
CollisionEstimator collisionEstimatorOf(const AnyEstimator& estimator);

}  // namespace pbrtmedia
