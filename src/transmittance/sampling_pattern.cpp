// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/sampling_pattern.h"

#include <algorithm>
#include <vector>

#include "base/hash.h"
#include "samplers/keys.h"

namespace pbrtmedia {
namespace {

constexpr double kBelowOne = 0x1.fffffffffffffp-1;

double hashedUnit(std::uint64_t key) { return static_cast<double>(mix64(key) >> 11) * 0x1p-53; }

constexpr std::array<std::uint32_t, SamplingPattern::kDimensions> firstPrimes() {
  std::array<std::uint32_t, SamplingPattern::kDimensions> primes{};
  std::size_t found = 0;
  for (std::uint32_t candidate = 2; found < primes.size(); ++candidate) {
    bool isPrime = true;
    for (std::size_t i = 0; i < found && primes[i] * primes[i] <= candidate; ++i) {
      isPrime = isPrime && candidate % primes[i] != 0;
    }
    if (isPrime) primes[found++] = candidate;
  }
  return primes;
}
constexpr auto kPrimes = firstPrimes();

double radicalInverse(std::uint64_t index, std::uint32_t base) {
  const double inverse = 1 / static_cast<double>(base);
  double digitWeight = inverse, value = 0;
  for (; index > 0; index /= base, digitWeight *= inverse) {
    value += static_cast<double>(index % base) * digitWeight;
  }
  return value;
}

/// Every digit d becomes (f d + g) mod base, f != 0 and g hashed from the digits before it; those past the
/// index's own are random.
double scrambledInverse(std::uint64_t index, std::uint32_t base, std::uint64_t key) {
  const double inverse = 1 / static_cast<double>(base);
  double digitWeight = inverse, value = 0;
  for (; digitWeight > 0x1p-53; index /= base, digitWeight *= inverse) {
    key = mix64(key);
    const std::uint64_t f = 1 + (key >> 32) % (base - 1), g = (key & 0xffffffffu) % base;
    const std::uint64_t digit = index % base;
    value += static_cast<double>((f * digit + g) % base) * digitWeight;
    key += (digit + 1) * kKeyStep;
  }
  return std::min(value, kBelowOne);
}

double shifted(double value, double shift) {
  const double sum = value + shift;
  return std::min(sum >= 1 ? sum - 1 : sum, kBelowOne);
}

}  // namespace

SamplingPattern::SamplingPattern(PatternKind kind, std::uint32_t count, std::uint64_t key)
    : kind_(kind), permutation_(count), key_(key) {}

double SamplingPattern::value(std::uint32_t index, std::uint32_t dimension) const {
  const std::uint64_t dimensionKey = subKey(key_, dimension);
  const double own = hashedUnit(hashCombine(dimensionKey, index));
  if (dimension >= kDimensions) return own;
  switch (kind_) {
    case PatternKind::Independent:
      return own;
    case PatternKind::LatinHypercube:
      return std::min((permutation_(index, dimensionKey) + own) / count(), kBelowOne);
    case PatternKind::Hammersley:
      if (dimension == 0) return shifted(static_cast<double>(index) / count(), hashedUnit(dimensionKey));
      return shifted(radicalInverse(index, kPrimes[dimension - 1]), hashedUnit(dimensionKey));
    case PatternKind::Halton:
      return shifted(radicalInverse(index, kPrimes[dimension]), hashedUnit(dimensionKey));
    case PatternKind::ScrambledHalton:
      return scrambledInverse(index, kPrimes[dimension], dimensionKey);
  }
  return own;
}

}  // namespace pbrtmedia
