// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "samplers/hashed_permutation.h"

namespace pbrtmedia {

/// How the random numbers of the estimates of one pixel relate to each other.
enum class PatternKind {
  Independent,     ///< not at all
  LatinHypercube,  ///< each dimension: a random permutation of `count` strata, jittered
  Hammersley,      ///< first dimension i / count, then radical inverses; one random shift per dimension
  Halton,          ///< radical inverses in successive primes; one random shift per dimension
  ScrambledHalton  ///< radical inverses with nested digit scrambling
};
inline constexpr std::array<std::string_view, 5> kPatternNames{"independent", "latinhypercube", "hammersley",
                                                               "halton", "scrambledhalton"};

/// `count` points in a cube of unbounded dimension: value(i, d) is the coordinate d of point i. Every
/// decision of an estimator takes one dimension. Each coordinate alone is uniform over the keys, so an
/// estimator's mean does not change; only the variance of the mean over the points does. Patterns know
/// kDimensions dimensions; beyond them numbers are hashed and independent, never repeated. A pure function of
/// (kind, count, key). Georgiev et al. 2019, section 6.3.
class SamplingPattern {
 public:
  static constexpr std::uint32_t kDimensions = 512;

  /// `count` in [1, 2^32): the number of estimates that share the pattern.
  SamplingPattern(PatternKind kind, std::uint32_t count, std::uint64_t key);

  PatternKind kind() const { return kind_; }
  std::uint32_t count() const { return permutation_.size(); }
  /// In [0, 1). `index` < count.
  double value(std::uint32_t index, std::uint32_t dimension) const;

 private:
  PatternKind kind_;
  HashedPermutation permutation_;
  std::uint64_t key_;
};

}  // namespace pbrtmedia
