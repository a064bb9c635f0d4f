// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <string_view>

#include "transmittance/law.h"

namespace pbrtmedia {

/// What an estimator promises, for help, docs, error messages and contract tests. Every estimator has a
/// member traits(), as parameters may change the answer.
struct EstimatorTraits {
  enum class Bias {
    Unbiased,    ///< the mean is T
    Consistent,  ///< the mean tends to T as the cost of one estimate grows
    Biased       ///< neither
  };
  /// What the upper bound (majorant) must be for the answers above to hold.
  enum class Control {
    Unused,    ///< not looked at
    CostOnly,  ///< sets the cost; the mean does not depend on it
    Any,       ///< positive where the extinction is; it may be too low
    Bounding   ///< nowhere below the extinction
  };

  std::string_view summary;  ///< what it computes, in one sentence
  std::string_view source;   ///< papers with equations
  std::string_view useWhen;  ///< advice, in one sentence
  Bias bias = Bias::Unbiased;
  std::string_view biasNote = "";     ///< when and how large; empty: nothing to add
  bool mayLeaveUnitInterval = false;  ///< even under a bounding control
  Control control = Control::Any;
  bool finiteVariance = true;           ///< under a bounding control
  bool finiteVarianceUnbounded = true;  ///< under a control too low by any factor, on a finite line
  bool boundedCost = false;             ///< lookups of one estimate have an upper limit
  bool needsPieces = false;             ///< asks for a PiecewiseCubicLine (fields/density_line.h)
  bool tellsSpread = false;             ///< has a member `paired`, which tells the noise (PairedEstimate)
  LawSet laws = LawSet::exponential();
};

std::string_view nameOf(EstimatorTraits::Bias bias);
std::string_view nameOf(EstimatorTraits::Control control);

}  // namespace pbrtmedia
