// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "samplers/keys.h"

// Digital sequences in base 2 and their scrambling. Values are kept as 32 digits, *first (most significant)
// digit in the lowest bit*: then the van der Corput sequence is the index itself, and nested scrambling,
// where a digit may depend on the digits before it, is what addition and multiplication do by themselves.
namespace pbrtmedia {

constexpr std::uint32_t reverseBits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/// Random nested uniform (Owen) scrambling of digits: whether a digit flips depends on the digits before it.
/// The idea of doing it by a hash whose carries run from the lowest bit upward is of Laine & Karras 2011
/// (doi:10.1111/j.1467-8659.2011.01991.x); this hash is our own. Odd factors, even factors after an exclusive
/// or, and additions each keep the order of dependence. Flips of different prefixes are pairwise independent
/// as far as base_two_test can see.
constexpr std::uint32_t owenScramble(std::uint32_t digits, std::uint64_t key) {
  const std::uint32_t a = static_cast<std::uint32_t>(key), b = static_cast<std::uint32_t>(key >> 32);
  std::uint32_t x = digits ^ a;
  x ^= x * 0x3a8f05c6u;
  x = (x + b) * ((a >> 7) | 1u);
  x ^= x * 0x9e3779bau;
  x = (x + a) * ((b >> 5) | 1u);
  return x ^ (x * 0x5851f42eu);
}

/// Owen-shuffled index: a random permutation of [0, 2^bits) that maps aligned blocks of 2^k to aligned
/// blocks, one of its own for every further block of 2^bits indices. Prefixes of 2^k indices therefore stay
/// intervals.
constexpr std::uint32_t owenShuffle(std::uint32_t index, int bits, std::uint64_t key) {
  if (bits == 0) return index;
  const std::uint32_t mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
  const std::uint32_t low = index & mask, block = index ^ low;
  if (block != 0) key = subKey(key, block);
  const std::uint32_t digits = reverseBits(low) >> (32 - bits);  // highest bit of the block first
  return block | (reverseBits(owenScramble(digits, key) & mask) >> (32 - bits));
}

/// A random permutation of [0, n): nested scrambling of the bits from the lowest up, then from the highest
/// down, repeated while the result lies outside.
constexpr std::uint32_t shuffleBelow(std::uint32_t i, std::uint32_t n, std::uint64_t key) {
  const int bits = static_cast<int>(std::bit_width(n - 1));
  if (bits == 0) return 0;
  const std::uint32_t mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
  const std::uint64_t second = subKey(key, 1);
  do {
    const std::uint32_t upwards = owenScramble(i, key) & mask;
    const std::uint32_t digits = reverseBits(upwards) >> (32 - bits);
    i = reverseBits(owenScramble(digits, second) & mask) >> (32 - bits);
  } while (i >= n);
  return i;
}

/// Shuffled index of sample `index` of `count` per pixel. The first `count` samples use the first `count`
/// indices of the sequence, and so does each prefix of 2^k samples: indices from 2^k up to 2^(k+1) or `count`
/// are permuted among themselves, and so is each further block of `count`. Slots shuffled like this are
/// nearly as good together as independent ones; under `owenShuffle`, products over two slots have up to twice
/// the variance, since samples 2i and 2i + 1 are then opposite in every slot.
constexpr std::uint32_t prefixShuffle(std::uint32_t index, std::uint32_t count, std::uint64_t key) {
  if (index < 2) return index;
  std::uint32_t first = 0, size = count;
  if (index < count) {
    first = std::bit_floor(index);
    size = first < count - first ? first : count - first;
  } else {
    first = index - index % count;
  }
  return first + shuffleBelow(index - first, size, subKey(key, first));
}

/// Digits to [0, 1).
constexpr float digitsToUnit(std::uint32_t digits) { return unitFloat(reverseBits(digits)); }

/// Second dimension of Sobol's sequence: digit j is the sum of binomial(k, j) times index bit k, mod 2.
/// Binomials are odd where the bits of j are a subset of those of k (Lucas), so this is a sum over supersets,
/// which five butterfly steps give. With the index itself as first dimension it is a (0, 2)-sequence.
constexpr std::uint32_t sobolSecond(std::uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  return index ^ (index >> 16);
}

/// Direction numbers of one dimension from its primitive polynomial x^degree + ... + 1 (`inner`: the bits of
/// the inner coefficients) and first numbers m. Bratley & Fox 1988, doi:10.1145/42288.214372, Eqs. (1)-(3).
template <std::size_t kDegree>
constexpr std::array<std::uint32_t, 32> sobolDirections(std::uint32_t inner,
                                                        std::array<std::uint32_t, kDegree> first) {
  std::array<std::uint32_t, 32> v{};
  for (std::size_t k = 0; k < 32; ++k) {
    if (k < kDegree) {
      v[k] = first[k] << (31 - k);
      continue;
    }
    v[k] = v[k - kDegree] ^ (v[k - kDegree] >> kDegree);
    for (std::size_t j = 1; j < kDegree; ++j) {
      if ((inner >> (kDegree - 1 - j)) & 1u) v[k] ^= v[k - j];
    }
  }
  for (std::uint32_t& direction : v) direction = reverseBits(direction);
  return v;
}

/// Third and fourth dimension: polynomials x^2+x+1 and x^3+x+1, first numbers of Joe & Kuo 2008
/// (doi:10.1137/070709359), table new-joe-kuo-6.
inline constexpr std::array<std::array<std::uint32_t, 32>, 2> kSobolHigher{sobolDirections<2>(1, {1, 3}),
                                                                           sobolDirections<3>(1, {1, 3, 1})};

/// Digits of dimension 0 to 3 of Sobol's sequence.
constexpr std::uint32_t sobolDigits(std::uint32_t index, int dimension) {
  if (dimension == 0) return index;
  if (dimension == 1) return sobolSecond(index);
  const auto& directions = kSobolHigher[static_cast<std::size_t>(dimension - 2)];
  std::uint32_t digits = 0;
  for (; index != 0; index &= index - 1)
    digits ^= directions[static_cast<std::size_t>(std::countr_zero(index))];
  return digits;
}

constexpr Point2f zeroTwoPoint(std::uint32_t index, std::uint64_t key) {
  return {digitsToUnit(owenScramble(index, subKey(key, 1))),
          digitsToUnit(owenScramble(sobolSecond(index), subKey(key, 2)))};
}

/// Point of the scrambled van der Corput or (0, 2)-sequence of a slot: `key` chooses shuffle and scrambling
/// of `count` samples per pixel. Indices of 2^32 and more begin a new sequence.
constexpr float scrambledVanDerCorput(std::uint64_t index, std::uint32_t count, std::uint64_t key) {
  if (index >> 32) key = hashCombine(key, index >> 32);
  const std::uint32_t i = prefixShuffle(static_cast<std::uint32_t>(index), count, key);
  return digitsToUnit(owenScramble(i, subKey(key, 1)));
}
constexpr Point2f scrambledZeroTwo(std::uint64_t index, std::uint32_t count, std::uint64_t key) {
  if (index >> 32) key = hashCombine(key, index >> 32);
  return zeroTwoPoint(prefixShuffle(static_cast<std::uint32_t>(index), count, key), key);
}
/// The same for arrays: with an Owen shuffle, since there the aligned run of each sample should be a net,
/// too.
constexpr Point2f scrambledZeroTwoRun(std::uint64_t index, int bits, std::uint64_t key) {
  if (index >> 32) key = hashCombine(key, index >> 32);
  return zeroTwoPoint(owenShuffle(static_cast<std::uint32_t>(index), bits, key), key);
}

/// Number of bits of indices below `count`, at most 32.
constexpr int indexBits(std::uint64_t count) {
  const int bits = static_cast<int>(std::bit_width(count > 0 ? count - 1 : 0));
  return bits < 32 ? bits : 32;
}

}  // namespace pbrtmedia
