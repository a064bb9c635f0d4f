// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/hash.h"
#include "base/math.h"
#include "samplers/keys.h"

namespace pbrtmedia {

/// Radical inverse of `index` in a prime base with nested scrambling: each digit d becomes (f d + g) mod base
/// with f != 0 and g random for every prefix of digits before it. These maps send each pair of digits to
/// every pair of different digits equally often, which is all that the variance of Owen's full permutations
/// depends on (Matoušek 1998, doi:10.1006/jcom.1998.0489). Digits past those of the first `count` indices are
/// random. Among the first base^k indices each interval of length base^-k holds one value.
template <std::uint32_t kBase>
float scrambledRadicalInverse(std::uint64_t index, std::uint64_t count, std::uint64_t key) {
  constexpr std::uint64_t kEnough = std::uint64_t{1} << 40;  // denominator beyond which floats see nothing
  std::uint64_t numerator = 0, denominator = 1;
  while ((denominator < count || index > 0) && denominator < kEnough) {
    const std::uint64_t digit = index % kBase;
    index /= kBase;
    key = mix64(key);
    const std::uint64_t f = 1 + (((key >> 32) * (kBase - 1)) >> 32);
    const std::uint64_t g = ((key & 0xffffffffu) * kBase) >> 32;
    numerator = numerator * kBase + (f * digit + g) % kBase;
    denominator *= kBase;
    key += (digit + 1) * kKeyStep;
  }
  const double rest = static_cast<double>(hashCombine(key, index) >> 11) * 0x1p-53;
  return std::min(
      static_cast<float>((static_cast<double>(numerator) + rest) / static_cast<double>(denominator)),
      kOneMinusEpsilon);
}

}  // namespace pbrtmedia
