// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "transmittance/traits.h"

namespace pbrtmedia {

/// What an estimator of 1/F promises, for help, docs and contract tests. Every estimator has a member
/// traits(), as parameters may change the answer. F > 0 throughout.
struct ReciprocalTraits {
  std::string_view summary;  ///< what it computes, in one sentence
  std::string_view source;   ///< papers with equations
  std::string_view useWhen;  ///< advice, in one sentence
  EstimatorTraits::Bias bias = EstimatorTraits::Bias::Unbiased;
  std::string_view biasNote = "";  ///< when and how large; empty: nothing to add
  std::string_view domain;         ///< the densities and controls for which the mean exists
  EstimatorTraits::Control control = EstimatorTraits::Control::Any;
  bool needsPositiveDensity = false;  ///< the domain leaves out densities that touch 0
  bool finiteVariance = true;         ///< in the domain, under a bounding control
  std::string_view varianceNote;      ///< how large, or when finite
  /// With r = 1 - density / control at points spread by the control: series about the control have a mean
  /// where E|r| < 1, and a finite variance where E[r^2] is below this, too. 0: no such series.
  double seriesLimit = 0;
  std::string_view cost;              ///< mean look-ups
  bool costGrowsWithControl = false;  ///< as alpha / F does
  bool boundedCost = false;           ///< look-ups of one estimate have an upper limit
};

}  // namespace pbrtmedia
