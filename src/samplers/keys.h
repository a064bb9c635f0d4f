// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "base/hash.h"
#include "base/math.h"
#include "base/vec.h"

// Keys of the samplers: 64-bit hashes from which scramblings and random numbers follow.
namespace pbrtmedia {

/// Step between numbered keys (2^64 / golden ratio, odd): `mix64(key + n * kKeyStep)` is a fresh key for each
/// n.
inline constexpr std::uint64_t kKeyStep = 0x9e3779b97f4a7c15ull;

constexpr std::uint64_t subKey(std::uint64_t key, std::uint64_t n) { return mix64(key + n * kKeyStep); }

/// Key of a pixel. Any coordinates, negative ones too.
constexpr std::uint64_t pixelKey(std::uint64_t seed, Point2i pixel) {
  return hashCombine(
      seed, (std::uint64_t{static_cast<std::uint32_t>(pixel.x)} << 32) | static_cast<std::uint32_t>(pixel.y));
}

/// Uniform multiples of 2^-24 in [0, 1) from the top bits of a key, or from both halves.
constexpr float unitFloat(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
constexpr float keyToUnit(std::uint64_t key) { return unitFloat(static_cast<std::uint32_t>(key >> 32)); }
constexpr Point2f keyToSquare(std::uint64_t key) {
  return {unitFloat(static_cast<std::uint32_t>(key >> 32)), unitFloat(static_cast<std::uint32_t>(key))};
}

}  // namespace pbrtmedia
