// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>

#include "tools/medialab/isolated.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Standard errors beyond which a mean is wrong.
inline constexpr double kMostAbsZ = 5;

/// What a stress test concludes from the trials of one cell.
struct StressVerdict {
  enum class Kind {
    Pass,
    Expected,   ///< the traits say that it cannot work, and nothing worse happened
    Undecided,  ///< the trials are too few for events as rare as these
    Skipped,
    Fail
  };
  Kind kind = Kind::Pass;
  std::string reason;
  std::string finite, inRange, unbiased;  ///< "yes", "no", "not claimed" or "-"
  double z = 0;                           ///< (mean - exact) / standard error; NaN without trials
};
std::string_view nameOf(StressVerdict::Kind kind);

/// What is known of the line beforehand.
struct StressSetting {
  double exact = 1;         ///< transmittance
  double depth = 0;         ///< optical depth
  double controlDepth = 0;  ///< optical depth of the upper control
  double control = 1;       ///< upper control / largest density, in every interval
  bool isBounding = true;   ///< the control is a bound
  bool isBlind = false;     ///< a bound of 0 hides density
};

/// Compares what happened with what the traits promise. A mean is refuted only by evidence that holds for
/// tails as heavy as the traits allow: |z| > 5, and for values that stay in [0, 1] also a Chernoff bound
/// below the probability of |z| > 5. Not while one trial alone makes most of the variance, nor where the
/// weights of Poisson processes spread too far for so few trials: their relative second moment is
/// exp(integral of mu^2 / control), at most exp(depth / control).
StressVerdict judge(const EstimatorTraits& traits, const StressSetting& setting,
                    const IsolatedResult& result);

/// Whether a mean `z` standard errors off is refuted when nothing is known of its values: not by few trials,
/// nor while one of them makes most of the variance.
struct Judgement {
  StressVerdict::Kind kind;
  std::string reason;
};
Judgement judgeMean(const TrialStats& stats, double z);

/// What is wrong with how the trials ended, if anything is. `mayTakeLong`: the control is so deep that a
/// single estimate may take seconds, which the traits tell.
std::optional<Judgement> judgeEnd(const IsolatedResult& result, bool mayTakeLong, double controlDepth);

/// log of the bound 2 exp(-n KL(mean || expected)) on the probability that the mean of n independent values
/// in [0, 1] lies as far from its expectation as `mean` does. Hoeffding 1963,
/// doi:10.1080/01621459.1963.10500830.
double logChernoffBound(double mean, double expected, double n);

}  // namespace pbrtmedia
