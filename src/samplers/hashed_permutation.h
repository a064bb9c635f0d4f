// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/hash.h"
#include "samplers/keys.h"

namespace pbrtmedia {

/// Random permutations of [0, n), one for each key, evaluated one element at a time.
///
/// Up to kShuffled elements the permutation is exactly uniform over all n!: an inside-out shuffle followed
/// for one element only. Above, a Feistel network on a rows x columns grid just larger than n (Black &
/// Rogaway 2002, doi:10.1007/3-540-45760-7_9, generalised Feistel cipher with cycle walking).
class HashedPermutation {
 public:
  /// n >= 1.
  explicit HashedPermutation(std::uint32_t n) : n_(n) {
    rows_ = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(n)));
    columns_ = (n + rows_ - 1) / rows_;
  }
  std::uint32_t size() const { return n_; }

  /// Place of element i < n.
  std::uint32_t operator()(std::uint32_t i, std::uint64_t key) const {
    return n_ <= kShuffled ? shuffle(i, key) : encipher(i, key);
  }

 private:
  static constexpr std::uint32_t kShuffled = 16;
  static constexpr int kRounds = 5;  ///< four leave a bias that a chi-square test over 400000 keys can see

  /// Element k of an inside-out shuffle goes to a random place <= k, and what was there moves to place k.
  std::uint32_t shuffle(std::uint32_t i, std::uint64_t key) const {
    std::uint32_t place = 0;
    for (std::uint32_t k = 0; k < n_; ++k) {
      const std::uint32_t to = static_cast<std::uint32_t>(((subKey(key, k) >> 32) * (k + 1)) >> 32);
      if (k == i) {
        place = to;
      } else if (k > i && place == to) {
        place = k;
      }
    }
    return place;
  }

  static std::uint32_t add(std::uint32_t a, std::uint64_t hash, std::uint32_t modulus) {
    a += static_cast<std::uint32_t>(((hash >> 32) * modulus) >> 32);
    return a >= modulus ? a - modulus : a;
  }
  std::uint32_t encipher(std::uint32_t i, std::uint64_t key) const {
    do {
      std::uint32_t row = i / columns_, column = i % columns_;
      std::uint64_t roundKey = key;
      for (int r = 0; r < kRounds; ++r) {
        row = add(row, roundFunction(roundKey ^ column), rows_);
        roundKey += kKeyStep;
        column = add(column, roundFunction(roundKey ^ row), columns_);
        roundKey += kKeyStep;
      }
      i = row * columns_ + column;
    } while (i >= n_);
    return i;
  }
  static std::uint64_t roundFunction(std::uint64_t h) {
    h *= 0xbf58476d1ce4e5b9ull;
    return (h ^ (h >> 32)) * 0x94d049bb133111ebull;
  }

  std::uint32_t n_, rows_, columns_;
};

}  // namespace pbrtmedia
