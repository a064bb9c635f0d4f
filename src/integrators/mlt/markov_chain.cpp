// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/mlt/markov_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/hash.h"
#include "spectrum/magnitudes.h"

namespace pbrtmedia {
namespace {

/// Of small steps, where media draw from an Rng, those that seed it anew.
constexpr float kRedrawProbability = 0.25f;

constexpr std::size_t kNumbers = 8;  ///< of a state, besides its sampler

void addSplat(const SizedSample& s, float weight, SplatBuffer& splats) {
  if (!(weight > 0)) return;
  splats.add(s.sample.film, s.sample.value * (weight / s.size));
  for (const StrategySample& other : s.elsewhere) splats.add(other.film, other.value * (weight / s.size));
}

void addTo(SizedSample& sum, const StrategySample& term) {
  if (sum.sample.value.isBlack()) sum.sample.film = term.film;
  if (sum.sample.film == term.film) {
    sum.sample.value += term.value;
  } else {
    sum.elsewhere.push_back(term);
  }
}

void saveSample(const StrategySample& s, std::vector<double>& out) {
  for (const float number : {s.film.x, s.film.y, s.value.r, s.value.g, s.value.b})
    out.push_back(double{number});
}
constexpr std::size_t kNumbersOfSample = 5;
StrategySample sampleFrom(std::span<const double> at) {
  const auto number = [&](std::size_t i) { return static_cast<float>(at[i]); };
  return {{number(0), number(1)}, {number(2), number(3), number(4)}};
}

}  // namespace

SizedSample sizedSample(const ChainSetup& setup, int depth, PrimarySampler& sampler,
                        RenderCounters& counters) {
  SizedSample sum;
  for (const ChainSetup::Term& term : setup.terms) {
    if (depth > term.maxDepth) continue;
    sampler.start({0, 0}, 0);  // each from the same numbers
    StrategySample s = sampleStrategy(term.strategies, term.media, term.on, depth, sampler, counters);
    if (s.value.isBlack() || !setup.film.admit(s.value, counters)) continue;
    sum.size += magnitudes(s.value).luminance();
    s.value *= term.factor;
    addTo(sum, s);
  }
  sum.size /= static_cast<float>(setup.terms.size());
  return sum;
}

bool ChainSetup::hasMedia() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.strategies.media != nullptr; });
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
  current_ = {sampleFrom(at.subspan(2)), static_cast<float>(at[7])};
  at = at.subspan(kNumbers);
  if (setup.isSum()) restoreElsewhere(at);
  sampler_.restore(at);
}

void MarkovChain::restoreElsewhere(std::span<const double>& at) {
  const auto count = at.empty() ? 0 : static_cast<std::size_t>(at[0]);
  if (at.size() < 1 + count * kNumbersOfSample) throw std::length_error("the state of a chain ends early");
  at = at.subspan(1);
  for (std::size_t i = 0; i < count; ++i, at = at.subspan(kNumbersOfSample))
    current_.elsewhere.push_back(sampleFrom(at));
}

void MarkovChain::save(const ChainSetup& setup, std::vector<double>& out) const {
  out.push_back(static_cast<double>(depth_));
  out.push_back(static_cast<double>(mutations_));
  saveSample(current_.sample, out);
  out.push_back(double{current_.size});
  if (setup.isSum()) {
    out.push_back(static_cast<double>(current_.elsewhere.size()));
    for (const StrategySample& other : current_.elsewhere) saveSample(other, out);
  }
  sampler_.save(out);
}

void MarkovChain::mutate(const ChainSetup& setup, float scale, SplatBuffer& splats,
                         RenderCounters& counters) {
  Rng choices(hashCombine(key_, mutations_));
  ++mutations_;
  const bool isLarge = choices.uniform() < setup.largeStepProbability;
  const bool redraws = choices.uniform() < kRedrawProbability && setup.hasMedia();
  const float threshold = choices.uniform();
  if (isLarge) {
    sampler_.proposeLarge(choices.next());
  } else {
    sampler_.proposeSmall(choices.next(), redraws);
  }
  SizedSample proposed = sizedSample(setup, depth_, sampler_, counters);
  const float acceptance = std::min(1.0f, proposed.size / current_.size);
  kept_ += 1 - acceptance;
  if (threshold < acceptance) {
    flush(scale, splats);
    current_ = std::move(proposed);
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
