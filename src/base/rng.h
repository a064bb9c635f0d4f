// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <bit>
#include <cstdint>

#include "base/hash.h"
#include "base/math.h"

namespace pbrtmedia {

/// xoshiro256++ (Blackman & Vigna 2021, doi:10.1145/3460772): period 2^256 - 1, a handful of cycles a number.
/// A value type: copy it to fork a replay. Not thread-safe; every (pixel, sample) owns one.
class Rng {
 public:
  /// Seeds the four words by the counter-based mixer, so neighbouring seeds give unrelated streams.
  explicit Rng(std::uint64_t seed = 0) {
    for (std::uint64_t& word : state_) word = mix64(seed += 0x9e3779b97f4a7c15ull);
  }

  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }
  /// Uniform in [0, 1): the multiples of 2^-24, so 1 is never reached.
  float uniform() { return static_cast<float>(next() >> 40) * 0x1p-24f; }
  /// Uniform in [0, 1): the multiples of 2^-53.
  double uniformDouble() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Uniform integer in [0, n), n > 0; multiply-shift, bias below n / 2^32.
  std::uint32_t uniformInt(std::uint32_t n) {
    return static_cast<std::uint32_t>(((next() >> 32) * std::uint64_t{n}) >> 32);
  }
  /// Standard exponential variate, always finite and > 0 (from the midpoints of 2^52 intervals).
  double exponential() { return -std::log((static_cast<double>(next() >> 12) + 0.5) * 0x1p-52); }

 private:
  std::uint64_t state_[4];
};

}  // namespace pbrtmedia
