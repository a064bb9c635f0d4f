// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "base/rng.h"
#include "transmittance/sampling_pattern.h"

namespace pbrtmedia {

/// Where an estimate takes its random numbers from, one dimension a decision: independent ones, or those of
/// one point of a pattern that the estimates of a pixel share. Borrows both; not thread-safe.
class SampleStream {
 public:
  explicit SampleStream(Rng& rng) : rng_(&rng) {}
  /// Point `index` of `pattern`, from its first dimension on.
  SampleStream(Rng& rng, const SamplingPattern& pattern, std::uint32_t index)
      : rng_(&rng), pattern_(&pattern), index_(index) {}

  /// Uniform in [0, 1).
  double uniform() {
    if (pattern_ == nullptr) [[likely]] {
      return rng_->uniformDouble();
    }
    return pattern_->value(index_, dimension_++);
  }
  /// Uniform in (0, 1].
  double uniformAboveZero() { return 1 - uniform(); }
  /// Standard exponential variate, finite, >= 0.
  double exponential() {
    if (pattern_ == nullptr) [[likely]] {
      return rng_->exponential();
    }
    return -std::log1p(-uniform());
  }
  /// For numbers that are no dimension of the estimate, such as probes that change nothing.
  Rng& rng() { return *rng_; }

 private:
  Rng* rng_;
  const SamplingPattern* pattern_ = nullptr;
  std::uint32_t index_ = 0, dimension_ = 0;
};

}  // namespace pbrtmedia
