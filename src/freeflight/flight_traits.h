// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "transmittance/law.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// What a free-flight sampler promises, for help, docs, error messages and contract tests.
struct FlightTraits {
  std::string_view summary;  ///< how it finds the next collision, in one sentence
  std::string_view source;   ///< papers with equations
  std::string_view useWhen;  ///< advice, in one sentence
  EstimatorTraits::Bias bias = EstimatorTraits::Bias::Unbiased;
  std::string_view biasNote = "";  ///< when and how large; empty: nothing to add
  EstimatorTraits::Control control = EstimatorTraits::Control::Any;
  LawSet laws = LawSet::exponential();
  bool needsPieces = false;    ///< asks for a PiecewiseCubicLine (fields/density_line.h)
  bool mayBeNegative = false;  ///< weights, even under a bounding control
  bool unitWeights = false;    ///< one channel, under a bounding control: every weight is exactly 1
};

}  // namespace pbrtmedia
