// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <type_traits>

#include "base/rng.h"
#include "support/running_stats.h"

namespace pbrtmedia::test {

/// The threshold of the whole project: two-sided p = 5.7e-7, so 1000 assertions alarm falsely 6e-4 times.
inline constexpr double kMaxAbsZ = 5.0;

/// The difference that tests of whole renders must be able to see, as a share of the truth.
inline constexpr double kVisible = 0.01;

/// Probability that a standard normal variate lies at least |z| from 0.
inline double twoSidedPValue(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// An estimated mean against the truth. Sees biases of about kMaxAbsZ + 2 standard errors.
struct ZTest {
  double mean = 0, truth = 0;
  double standardError = 0;       ///< of `mean`
  double truthStandardError = 0;  ///< of `truth`, when that is an estimate too
  std::uint64_t seed = 0, n = 0;

  /// Signed distance in standard errors. Without any spread: 0 when both agree to rounding, else infinite.
  /// NaN when a value was not a number, so that `EXPECT_LT(std::abs(z), kMaxAbsZ)` fails.
  double z() const {
    const double spread = std::hypot(standardError, truthStandardError), distance = mean - truth;
    const double rounding = 1e-9 * std::max(std::abs(mean), std::abs(truth));
    if (!(spread > 0) && std::abs(distance) <= rounding) return 0;
    if (spread == 0 && !std::isnan(distance))
      return std::copysign(std::numeric_limits<double>::infinity(), distance);
    return distance / spread;
  }
  double pValue() const { return twoSidedPValue(z()); }
  /// Whether a mean that is off by this share of the truth would be seen.
  bool sees(double share = kVisible) const {
    return kMaxAbsZ * std::hypot(standardError, truthStandardError) <= share * std::abs(truth);
  }
  friend std::ostream& operator<<(std::ostream& os, const ZTest& t) {
    const auto old = os.precision(9);
    os << "mean " << t.mean << ", truth " << t.truth << ", standard error " << t.standardError
       << " (of truth " << t.truthStandardError << "), z " << t.z() << ", seed " << t.seed << ", n " << t.n;
    os.precision(old);
    return os;
  }
};

/// Values gathered elsewhere against a known mean.
inline ZTest zTest(const RunningStats& values, double truth, std::uint64_t seed = 0) {
  return {values.mean(), truth, values.standardError(), 0, seed, values.count()};
}

/// Two independent sets of values against each other.
inline ZTest zTest(const RunningStats& a, const RunningStats& b, std::uint64_t seed = 0) {
  return {a.mean(), b.mean(), a.standardError(), b.standardError(), seed, a.count() + b.count()};
}

/// Draws n independent values by `draw(Rng&)`, all from one Rng seeded with `seed`.
template <class Draw>
requires std::is_invocable_r_v<double, Draw&, Rng&> ZTest runZTest(Draw&& draw, double truth,
                                                                   std::uint64_t seed, std::uint64_t n) {
  Rng rng(seed);
  RunningStats values;
  for (std::uint64_t i = 0; i < n; ++i) values.add(static_cast<double>(draw(rng)));
  return zTest(values, truth, seed);
}

}  // namespace pbrtmedia::test
