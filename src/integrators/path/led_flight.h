// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "base/pixel_stream.h"
#include "base/rng.h"
#include "samplers/base_two.h"

namespace pbrtmedia {

/// While it lives, the first word that `rng` gives is that of a stratified number: those of all samples of a
/// pixel are a scrambled van der Corput sequence. The first word of a flight decides most about where it
/// ends, so the first collisions of a pixel's paths are spread evenly, as a sampler's dimension would spread
/// them, but without one: what draws nothing moves no dimension and leaves `rng` as it was.
///
/// Three words of the state stay as they are, and for each of them there is exactly one fourth with which a
/// given word comes next: what follows has the distribution that it has behind that word by chance. Unbiased,
/// as every single number is uniform. Nothing happens where the sample of the pixel is not known.
class LedFlight {
 public:
  /// `number`: of the flight among those of the sample that are led.
  LedFlight(Rng& rng, const PixelSample& sample, std::uint64_t number) : rng_(rng), before_(rng), led_(rng) {
    if (sample.count == 0) return;
    const float u = scrambledVanDerCorput(sample.index, kAnyCount, subKey(sample.key, kFirst + number));
    led_ = withNext(rng, u);
    rng_ = led_;
  }
  ~LedFlight() {
    if (!isTaken()) rng_ = before_;
  }
  LedFlight(const LedFlight&) = delete;
  LedFlight& operator=(const LedFlight&) = delete;

  /// Whether something was drawn.
  bool isTaken() const { return wordsOf(rng_) != wordsOf(led_); }

 private:
  using Words = std::array<std::uint64_t, 4>;
  /// "fly" in ASCII: the estimates of a pixel that share patterns count their keys from 0.
  static constexpr std::uint64_t kFirst = 0x666c79ull << 32;
  /// However many samples are planned: a render that goes on for longer takes the same ones first.
  static constexpr std::uint32_t kAnyCount = std::numeric_limits<std::uint32_t>::max();

  static Words wordsOf(const Rng& rng) { return std::bit_cast<Words>(rng); }
  /// `rng` with the 24 bits of `u` on top of its next word.
  static Rng withNext(const Rng& rng, float u) {
    Rng copy = rng;
    const std::uint64_t word = (static_cast<std::uint64_t>(u * 0x1p24f) << 40) | (copy.next() >> 24);
    Words words = wordsOf(rng);
    words[3] = std::rotr(word - words[0], 23) - words[0];
    return std::bit_cast<Rng>(words);
  }

  Rng& rng_;
  Rng before_, led_;
};

}  // namespace pbrtmedia
