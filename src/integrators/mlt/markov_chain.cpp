// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/mlt/markov_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/hash.h"

namespace pbrtmedia {
namespace {

/// Of small steps, where media draw from an Rng, those that seed it anew.
constexpr float kRedrawProbability = 0.25f;

constexpr std::size_t kNumbers = 8;  ///< of a state, besides its sampler

void addSplat(const SizedSample& s, float weight, SplatBuffer& splats) {
  if (weight > 0) splats.add(s.sample.film, s.sample.value * (weight / s.size));
}

}  // namespace

SizedSample sizedSample(const ChainSetup& setup, int depth, PrimarySampler& sampler,
                        RenderCounters& counters) {
  SizedSample s{sampleStrategy(setup.strategies, setup.media, setup.on, depth, sampler, counters)};
  Rgb& value = s.sample.value;
  if (value.isBlack() || !setup.film.admit(value, counters)) return s;
  s.size = Rgb(std::abs(value.r), std::abs(value.g), std::abs(value.b)).luminance();
  return s;
}

MarkovChain::MarkovChain(const ChainSetup& setup, int depth, const PrimarySampler& at, std::uint64_t key,
                         RenderCounters& counters)
    : sampler_(at), depth_(depth), key_(key) {
  current_ = sizedSample(setup, depth_, sampler_, counters);
}

MarkovChain::MarkovChain(const ChainSetup& setup, std::uint64_t key, std::span<const double>& at)
    : sampler_(setup.sigma), key_(key) {
  if (at.size() < kNumbers) throw std::length_error("the state of a chain ends early");
  depth_ = static_cast<int>(at[0]);
  mutations_ = static_cast<std::uint64_t>(at[1]);
  const auto number = [&](std::size_t i) { return static_cast<float>(at[i]); };
  current_ = {{{number(2), number(3)}, {number(4), number(5), number(6)}}, number(7)};
  at = at.subspan(kNumbers);
  sampler_.restore(at);
}

void MarkovChain::save(std::vector<double>& out) const {
  const auto& [film, value] = current_.sample;
  for (const double number :
       {static_cast<double>(depth_), static_cast<double>(mutations_), double{film.x}, double{film.y},
        double{value.r}, double{value.g}, double{value.b}, double{current_.size}}) {
    out.push_back(number);
  }
  sampler_.save(out);
}

void MarkovChain::mutate(const ChainSetup& setup, float scale, SplatBuffer& splats,
                         RenderCounters& counters) {
  Rng choices(hashCombine(key_, mutations_));
  ++mutations_;
  const bool isLarge = choices.uniform() < setup.largeStepProbability;
  const bool redraws = choices.uniform() < kRedrawProbability && setup.strategies.media != nullptr;
  const float threshold = choices.uniform();
  if (isLarge) {
    sampler_.proposeLarge(choices.next());
  } else {
    sampler_.proposeSmall(choices.next(), redraws);
  }
  const SizedSample proposed = sizedSample(setup, depth_, sampler_, counters);
  const float acceptance = std::min(1.0f, proposed.size / current_.size);
  kept_ += 1 - acceptance;
  if (threshold < acceptance) {
    flush(scale, splats);
    current_ = proposed;
    kept_ = acceptance;
  } else {
    sampler_.reject();
    if (acceptance > 0) addSplat(proposed, scale * acceptance, splats);
  }
}

void MarkovChain::flush(float scale, SplatBuffer& splats) {
  addSplat(current_, scale * kept_, splats);
  kept_ = 0;
}

}  // namespace pbrtmedia
