// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "film/film.h"
#include "film/splat_buffer.h"
#include "integrators/mlt/strategy_sample.h"

namespace pbrtmedia {

/// What all chains of a render share.
struct ChainSetup {
  /// A scene of which an image is made, and its share of the sum of images.
  struct Term {
    const BdptSetup& strategies;
    const MediaTopology& media;
    StrategyFilm on;
    int maxDepth;
    float factor;
  };
  std::vector<Term> terms;  ///< mostly one, of factor 1
  const Film& film;
  float largeStepProbability;
  float sigma;

  bool hasMedia() const;
  bool isSum() const { return terms.size() > 1; }
};

/// A strategy sample and its size, in proportion to which chains visit it. Of a sum of images: what one point
/// of primary sample space brings to each, times its factor, and the mean of the sizes that it has in all of
/// them. So whatever brings anything to one of them is visited, and a splat over the size is bounded.
struct SizedSample {
  StrategySample sample;
  float size = 0;
  std::vector<StrategySample> elsewhere{};  ///< of a sum, on other places of the film
};
/// What the film does not take has no size.
SizedSample sizedSample(const ChainSetup& setup, int depth, PrimarySampler& sampler,
                        RenderCounters& counters);

/// One chain: a walk among paths of one number of scatterings, which visits them in proportion to their size
/// (Metropolis et al. 1953).
class MarkovChain {
 public:
  /// Starts where `at` stands; `key`: of the random numbers of all its mutations.
  MarkovChain(const ChainSetup& setup, int depth, const PrimarySampler& at, std::uint64_t key,
              RenderCounters& counters);
  /// From numbers that `save` wrote; `at` is moved behind them. Throws std::length_error for too few.
  MarkovChain(const ChainSetup& setup, std::uint64_t key, std::span<const double>& at);
  void save(const ChainSetup& setup, std::vector<double>& out) const;

  /// Proposes a mutation and goes there or stays. Both ends give splats by the probability of being there, of
  /// `scale` over their size: that of where it stays is kept for `flush`.
  void mutate(const ChainSetup& setup, float scale, SplatBuffer& splats, RenderCounters& counters);
  /// Adds what is kept.
  void flush(float scale, SplatBuffer& splats);

 private:
  void restoreElsewhere(std::span<const double>& at);

  PrimarySampler sampler_;
  int depth_;
  std::uint64_t key_;
  std::uint64_t mutations_ = 0;
  SizedSample current_;
  float kept_ = 0;  ///< how often it was there
};

}  // namespace pbrtmedia
