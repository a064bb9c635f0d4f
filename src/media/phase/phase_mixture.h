// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <vector>

#include "media/phase/phase_function.h"

namespace pbrtmedia {

/// A weighted sum of phase functions: sampling picks a lobe with its weight, and value and density are those
/// of the whole sum, so no sample weighs more than another.
class PhaseMixture final : public PhaseFunction {
 public:
  static constexpr std::string_view kTypeName = "mixture";
  struct Lobe {
    std::unique_ptr<PhaseFunction> function;
    double weight = 1;  ///< >= 0, relative to the others
  };

  /// At least one lobe, weights finite with a positive sum; otherwise SceneError (location unknown).
  explicit PhaseMixture(std::vector<Lobe> lobes);

  std::string_view typeName() const override { return kTypeName; }
  float evaluate(Vector3f wo, Vector3f wi) const override;
  Sample sample(Vector3f wo, Point2f u) const override;

 private:
  std::vector<Lobe> lobes_;  ///< weights sum to 1
};

}  // namespace pbrtmedia
