// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/mlt/mlt.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/hash.h"
#include "base/interruption.h"
#include "base/parallel.h"
#include "integrators/mlt/markov_chain.h"
#include "render/pass_loop.h"
#include "samplers/radical_inverse.h"

namespace pbrtmedia {
namespace {

/// "boot", "chai", "pick" in ASCII: keep random numbers of these apart from other uses of the same seed.
constexpr std::uint64_t kBootstrapTag = 0x626f6f74, kChainTag = 0x63686169, kPickTag = 0x7069636b;
/// Bootstrap samples of one unit of work.
constexpr std::uint64_t kSamplesOfUnit = 1024;
/// Bootstrap samples of a whole that is one of many, at least: chains are to have somewhere to start.
constexpr std::int64_t kLeastBootstrap = 1000;
/// Splats of one pass at most, bytes.
constexpr std::size_t kPassBytes = std::size_t{64} << 20;
constexpr std::size_t kSplatsPerMutation = 2;

}  // namespace

/// One render.
class MltIntegrator::Mutations {
 public:
  /// `terms`: of MltIntegrator. `parts`: wholes of which this is one, and the bootstrap has its share.
  Mutations(const MltIntegrator& mlt, std::span<const ImageTerm> terms, std::int64_t parts,
            const Sampler& sampler, Film& film, const RenderOptions& options)
      : params_(mlt.params_),
        film_(film),
        options_(options),
        bounds_(options.pixelBounds ? intersect(film.sampleBounds(), *options.pixelBounds)
                                    : film.sampleBounds()),
        pixels_(static_cast<std::uint64_t>(bounds_.area())),
        bootstrapSamples_(bootstrapOf(params_, parts)),
        setup_{termsOf(terms, bounds_, film), film, params_.largeStepProbability, params_.sigma},
        loop_(
            mlt.scene(), options,
            {.end = std::min(options.samplesPerPixel.value_or(sampler.samplesPerPixel()), options.endSample),
             .samplesPerIndex = pixels_,
             .pixels = pixels_,
             .mostPerPass = mostPerPass()}) {
    CHECK_EQ(options.firstSample, 0) << "chains go on from where they are";
    if (!loop_.carried().empty()) restore(loop_.carried());
  }

  RenderResult run() {
    return loop_.run([this](const Pass& pass) { return mutate(pass); },
                     [this](std::span<const UnitReport> units) { finish(units); });
  }

 private:
  static std::uint64_t bootstrapOf(const MltParams& params, std::int64_t parts) {
    const std::int64_t all = params.bootstrapSamples;
    return static_cast<std::uint64_t>(std::min(all, std::max(all / parts, kLeastBootstrap)));
  }
  static std::vector<ChainSetup::Term> termsOf(std::span<const ImageTerm> terms, const Bounds2i& bounds,
                                               const Film& film) {
    std::vector<ChainSetup::Term> all;
    for (const ImageTerm& term : terms) {
      const auto& mlt = dynamic_cast<const MltIntegrator&>(term.integrator);
      all.push_back({mlt.strategies_.setup(),
                     mlt.strategies_.media(),
                     {term.camera, bounds, film.imageArea()},
                     mlt.params_.maxDepth,
                     static_cast<float>(term.factor)});
    }
    return all;
  }
  std::int64_t mostPerPass() const {
    const std::size_t perIndex = static_cast<std::size_t>(std::max<std::uint64_t>(pixels_, 1)) *
                                 kSplatsPerMutation * setup_.terms.size() * sizeof(Splat);
    return static_cast<std::int64_t>(std::max<std::size_t>(1, kPassBytes / perIndex));
  }
  std::uint64_t depths() const {
    int most = 0;
    for (const ChainSetup::Term& term : setup_.terms) most = std::max(most, term.maxDepth);
    return static_cast<std::uint64_t>(most) + 1;
  }
  std::uint64_t keyOf(std::size_t chain) const { return hashCombine(options_.seed, chain, kChainTag); }
  int depthOf(std::uint64_t bootstrapSample) const { return static_cast<int>(bootstrapSample % depths()); }

  /// Sample number n of the bootstrap. Those of one number of scatterings are spread evenly over film and
  /// strategies, each by itself uniform.
  PrimarySampler bootstrapSample(std::uint64_t n) const {
    PrimarySampler sampler(params_.sigma);
    sampler.proposeLarge(hashCombine(options_.seed, n, kBootstrapTag));
    const std::uint64_t key = hashCombine(options_.seed, n % depths(), kBootstrapTag, kPickTag),
                        i = n / depths();
    const std::uint64_t count = bootstrapSamples_;
    const std::array film{scrambledRadicalInverse<2>(i, count, hashCombine(key, 2)),
                          scrambledRadicalInverse<3>(i, count, hashCombine(key, 3))};
    const std::array strategy{scrambledRadicalInverse<5>(i, count, hashCombine(key, 5))};
    sampler.set(PrimarySampler::Stream::Camera, film);
    sampler.set(PrimarySampler::Stream::Connection, strategy);
    return sampler;
  }

  std::vector<UnitReport> mutate(const Pass& pass) {
    std::vector<UnitReport> units;
    if (!isStarted_) {
      units = start();
      if (!areComplete(units)) return units;
      isStarted_ = true;
    }
    const std::uint64_t first = static_cast<std::uint64_t>(pass.first) * pixels_,
                        end = first + static_cast<std::uint64_t>(pass.count) * pixels_;
    const std::size_t before = units.size(), chains = static_cast<std::size_t>(params_.chains);
    units.resize(before + chains);
    splats_.assign(chains, {});
    parallelFor(chains, [&](std::size_t c) { walk(c, first, end, splats_[c], units[before + c]); });
    return units;
  }

  /// The bootstrap: what paths bring on average, and where chains start.
  std::vector<UnitReport> start() {
    // Number n is of n mod depths scatterings.
    const std::uint64_t count = bootstrapSamples_ * depths();
    std::vector<float> sizes(count);
    std::vector<UnitReport> units((count + kSamplesOfUnit - 1) / kSamplesOfUnit);
    parallelFor(units.size(), [&](std::size_t unit) {
      for (std::uint64_t n = unit * kSamplesOfUnit; n < std::min(count, (unit + 1) * kSamplesOfUnit); ++n) {
        if (loop_.shouldStop()) return;
        PrimarySampler sampler = bootstrapSample(n);
        try {
          sizes[n] = sizedSample(setup_, depthOf(n), sampler, units[unit].counters).size;
        } catch (const Interrupted&) {
          return;
        }
      }
      units[unit].complete = true;
    });
    if (!areComplete(units)) return units;
    double sum = 0;
    for (const float size : sizes) sum += double{size};
    mean_ = sum / static_cast<double>(bootstrapSamples_);
    if (sum > 0) startChains(sizes, sum, units.front().counters);
    return units;
  }

  /// Spreads the starts evenly over the sum of sizes.
  void startChains(std::span<const float> sizes, double sum, RenderCounters& counters) {
    const double offset = Rng(hashCombine(options_.seed, kPickTag)).uniformDouble();
    double reached = double{sizes.front()};
    std::uint64_t n = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(params_.chains); ++c) {
      const double wanted = (static_cast<double>(c) + offset) / params_.chains * sum;
      while (reached <= wanted && n + 1 < sizes.size()) reached += double{sizes[++n]};
      while (sizes[n] == 0) --n;  // rounding, at the end
      chains_.emplace_back(setup_, depthOf(n), bootstrapSample(n), keyOf(c), counters);
    }
  }

  /// The mutations of a chain among those from `first` to below `end`.
  void walk(std::size_t chain, std::uint64_t first, std::uint64_t end, SplatBuffer& splats,
            UnitReport& unit) {
    const auto step = static_cast<std::uint64_t>(params_.chains);
    std::uint64_t m = first + (chain + step - first % step) % step;
    const auto scale = static_cast<float>(mean_);
    while (m < end) {
      // All that it brings before each pixel has had one more: passes do not show.
      const std::uint64_t endOfIndex = (m / pixels_ + 1) * pixels_;
      for (; m < endOfIndex; m += step) {
        if (loop_.shouldStop() || !mutateOnce(chain, m - first, scale, splats, unit)) {
          if (!chains_.empty()) chains_[chain].flush(scale, splats);
          return;
        }
        ++unit.samples;
        if (m < pixels_) ++unit.pixelsSampled;
      }
      if (!chains_.empty()) chains_[chain].flush(scale, splats);
    }
    loop_.count(unit.samples);
    loop_.reportProgress();
    unit.complete = true;
  }

  /// False: it was left on its way.
  bool mutateOnce(std::size_t chain, std::uint64_t order, float scale, SplatBuffer& splats,
                  UnitReport& unit) {
    if (chains_.empty()) return true;
    splats.begin(order, chain % 2 != 0);
    try {
      chains_[chain].mutate(setup_, scale, splats, unit.counters);
    } catch (const Interrupted&) {
      ++unit.abandoned;
      return false;
    }
    return true;
  }

  /// Mutations count one by one, so part of a pass is in the image, too. Chains go on from whole passes.
  void finish(std::span<const UnitReport> units) {
    if (!isStarted_) return;
    film_.addSplats(splats_, {loop_.samplesOfPass(), static_cast<double>(pixels_)}, oddMutations(units));
    splats_.clear();
    if (areComplete(units)) save(loop_.carried());
  }

  /// Halves are of chains: mutations of one depend on each other. The units of chains are the last.
  std::uint64_t oddMutations(std::span<const UnitReport> units) const {
    const auto chains = static_cast<std::size_t>(params_.chains);
    std::uint64_t count = 0;
    for (std::size_t c = 1; c < chains; c += 2) count += units[units.size() - chains + c].samples;
    return count;
  }

  void save(std::vector<double>& out) const {
    out = {mean_, static_cast<double>(chains_.size())};
    for (const MarkovChain& chain : chains_) chain.save(setup_, out);
  }

  void restore(std::span<const double> from) {
    const SceneError broken({}, "the checkpoint lacks the chains of \"mlt\"");
    if (from.size() < 2) throw broken;
    mean_ = from[0];
    const double count = from[1];
    if (count != 0 && count != params_.chains) throw broken;
    from = from.subspan(2);
    try {
      for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c)
        chains_.emplace_back(setup_, keyOf(c), from);
    } catch (const std::length_error&) {
      throw broken;
    }
    isStarted_ = true;
  }

  const MltParams& params_;
  Film& film_;
  const RenderOptions& options_;
  Bounds2i bounds_;
  std::uint64_t pixels_;
  std::uint64_t bootstrapSamples_;  ///< of each number of scatterings
  ChainSetup setup_;
  bool isStarted_ = false;
  double mean_ = 0;                  ///< size of a path, over all of primary sample space
  std::vector<MarkovChain> chains_;  ///< none: no path brings light
  std::vector<SplatBuffer> splats_;  ///< of the pass at hand, by chains
  PassLoop loop_;
};

MltIntegrator::MltIntegrator(const Scene& scene, const MltParams& params,
                             std::unique_ptr<const LightSelector> selector,
                             std::unique_ptr<const LightSelector> startSelector, CameraMedium cameraMedium)
    : Integrator(scene),
      params_(params),
      strategies_(scene, {.maxDepth = params.maxDepth}, std::move(selector), std::move(startSelector),
                  std::move(cameraMedium)) {
  CHECK_GE(params.chains, 1);
  CHECK_GE(params.bootstrapSamples, 1);
}
MltIntegrator::~MltIntegrator() = default;

RenderResult MltIntegrator::render(const Camera& camera, const Sampler& sampler, Film& film,
                                   const RenderOptions& options) const {
  const ImageTerm whole{*this, camera, 1};
  return Mutations(*this, {&whole, 1}, 1, sampler, film, options).run();
}

RenderResult MltIntegrator::renderSum(std::span<const ImageTerm> terms,
                                      std::optional<std::int64_t> startsAgain, const Sampler& sampler,
                                      Film& film, const RenderOptions& options) const {
  return Mutations(*this, terms, startsAgain.value_or(1), sampler, film, options).run();
}

std::string MltIntegrator::whyInOnePiece() const {
  return "the chains of \"mlt\" go on from where all mutations before have led them";
}

}  // namespace pbrtmedia
