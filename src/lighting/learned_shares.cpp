// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/learned_shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pbrtmedia {
namespace {

constexpr int kSteps = 8;           ///< of the gradient: the noise is then within a per cent of its least
constexpr double kPriorTrials = 8;  ///< that say what the prior says, beside those of a cell
constexpr std::size_t kLeastTrials = 256;  ///< of a cell
constexpr int kMostDepth = 10;
/// Another cell, or factors, must make noise less by this part: what is found is found among many.
constexpr double kLeastGain = 0.03;

}  // namespace

class LearnedShares::Learner {
 public:
  Learner(const LightTrials& trials, const Prior& prior, LearnedShares& shares)
      : trials_(trials), prior_(prior), shares_(shares), clusters_(prior.powerShares.size()) {}

  void learn() {
    std::vector<std::uint32_t> all(trials_.size());
    std::iota(all.begin(), all.end(), 0u);
    shares_.clusters_ = clusters_;
    const Cell whole = cellOf(all);
    grow(all, whole, 0);
  }

 private:
  using Indices = std::vector<std::uint32_t>;
  using Factors = std::vector<double>;
  enum class Half { Even, Odd, Both };
  struct Cell {
    bool learns = false;  ///< other factors than 1 make its noise less
    double noise = 0;     ///< of its trials, each judged by factors that the other half has taught
  };

  bool isIn(Half half, std::uint32_t trial) const {
    return half == Half::Both || trials_[trial].isOdd == (half == Half::Odd);
  }

  /// The probabilities of the clusters for a trial without the part by power; the whole probability of its
  /// own.
  double probabilities(std::uint32_t trial, const Factors& factors, std::vector<double>& parts) const {
    const std::span<const float> importances = trials_.importances(trial);
    double sum = 0, shares = 0;
    for (std::size_t j = 0; j < clusters_; ++j) {
      parts[j] = static_cast<double>(importances[j]) * factors[j];
      sum += parts[j];
      if (importances[j] > 0) shares += prior_.powerShares[j];
    }
    for (double& part : parts) part *= (1 - prior_.defensiveShare) / sum;
    const std::uint32_t own = trials_[trial].cluster;
    return parts[own] + prior_.defensiveShare * prior_.powerShares[own] / shares;
  }

  double noise(const Indices& in, Half half, const Factors& factors) const {
    std::vector<double> parts(clusters_);
    double sum = 0;
    for (const std::uint32_t i : in) {
      if (isIn(half, i)) sum += trials_[i].moment / probabilities(i, factors, parts);
    }
    return sum;
  }

  Factors fit(const Indices& in, Half half) const {
    Factors factors(clusters_, 1.0);
    std::vector<double> parts(clusters_);
    for (int step = 0; step < kSteps; ++step) {
      std::vector<double> found(clusters_), expected(clusters_), mean(clusters_);
      double total = 0;
      std::size_t count = 0;
      for (const std::uint32_t i : in) {
        if (!isIn(half, i)) continue;
        const double own = probabilities(i, factors, parts);
        const std::uint32_t cluster = trials_[i].cluster;
        // What depends on the factors of the noise X² p / p'.
        const double square = trials_[i].moment / own * (parts[cluster] / own);
        found[cluster] += square;
        for (std::size_t j = 0; j < clusters_; ++j) {
          const double share = parts[j] / (1 - prior_.defensiveShare);
          expected[j] += square * share;
          mean[j] += share;
        }
        total += square;
        ++count;
      }
      if (!(total > 0)) return Factors(clusters_, 1.0);
      const double n = static_cast<double>(count), pseudo = kPriorTrials * total / n;
      for (std::size_t j = 0; j < clusters_; ++j) {
        const double towardPrior = pseudo * mean[j] / n / factors[j];
        if (mean[j] > 0)
          factors[j] *= std::sqrt((found[j] + towardPrior) / (expected[j] + pseudo * mean[j] / n));
      }
    }
    return factors;
  }

  Cell cellOf(const Indices& in) const {
    const Factors even = fit(in, Half::Even), odd = fit(in, Half::Odd), ones(clusters_, 1.0);
    const double learned = noise(in, Half::Odd, even) + noise(in, Half::Even, odd);
    const double plain = noise(in, Half::Both, ones);
    if (!(learned < (1 - kLeastGain) * plain)) return {false, plain};
    return {true, learned};
  }

  struct Split {
    std::size_t axis = 3;
    double position = 0;
    Indices below, above;
    Cell first, second;
  };

  /// In the middle of the trials, along the axis on which that is best; axis 3 where it does not pay.
  Split bestSplit(const Indices& in, const Cell& cell) const {
    Split best;
    double least = (1 - kLeastGain) * cell.noise;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<float> places;
      for (const std::uint32_t i : in) places.push_back(trials_[i].p[axis]);
      const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
      std::ranges::nth_element(places, middle);
      Split split{.axis = axis,
                  .position = static_cast<double>(*middle),
                  .below = {},
                  .above = {},
                  .first = {},
                  .second = {}};
      for (const std::uint32_t i : in) {
        const bool isBelow = static_cast<double>(trials_[i].p[axis]) < split.position;
        (isBelow ? split.below : split.above).push_back(i);
      }
      if (std::min(split.below.size(), split.above.size()) < kLeastTrials) continue;
      split.first = cellOf(split.below);
      split.second = cellOf(split.above);
      const double noise = split.first.noise + split.second.noise;
      if (!(noise < least)) continue;
      least = noise;
      best = std::move(split);
    }
    return best;
  }

  void grow(const Indices& in, const Cell& cell, int depth) {
    const auto number = shares_.nodes_.size();
    shares_.nodes_.push_back({});
    if (depth < kMostDepth && in.size() >= 2 * kLeastTrials) {
      const Split split = bestSplit(in, cell);
      if (split.axis < 3) {
        grow(split.below, split.first, depth + 1);
        const auto child = static_cast<std::uint32_t>(shares_.nodes_.size());
        grow(split.above, split.second, depth + 1);
        shares_.nodes_[number] = {split.position, static_cast<std::uint32_t>(split.axis), child};
        return;
      }
    }
    shares_.nodes_[number].second = static_cast<std::uint32_t>(shares_.cells_++);
    const Factors factors = cell.learns ? fit(in, Half::Both) : Factors(clusters_, 1.0);
    shares_.factors_.insert(shares_.factors_.end(), factors.begin(), factors.end());
  }

  const LightTrials& trials_;
  const Prior& prior_;
  LearnedShares& shares_;
  std::size_t clusters_;
};

LearnedShares LearnedShares::learn(const LightTrials& trials, const Prior& prior) {
  LearnedShares shares;
  if (trials.size() > 0) Learner(trials, prior, shares).learn();
  return shares;
}

std::span<const double> LearnedShares::at(Point3f p) const {
  if (nodes_.empty()) return {};
  std::size_t i = 0;
  while (nodes_[i].axis < 3)
    i = static_cast<double>(p[nodes_[i].axis]) < nodes_[i].split ? i + 1 : nodes_[i].second;
  return std::span(factors_).subspan(nodes_[i].second * clusters_, clusters_);
}

std::vector<double> LearnedShares::state() const {
  std::vector<double> state{static_cast<double>(clusters_), static_cast<double>(nodes_.size())};
  for (const Node& n : nodes_) {
    state.push_back(n.split);
    state.push_back(static_cast<double>(n.axis));
    state.push_back(static_cast<double>(n.second));
  }
  state.insert(state.end(), factors_.begin(), factors_.end());
  return state;
}

std::optional<LearnedShares> LearnedShares::ofState(std::span<const double> state, std::size_t clusters) {
  constexpr double kMost = 1 << 24;
  if (state.size() < 2 || !(state[1] >= 0 && state[1] <= kMost)) return std::nullopt;
  LearnedShares shares;
  const auto count = static_cast<std::size_t>(state[1]);
  if (count == 0) return state.size() == 2 ? std::optional(shares) : std::nullopt;
  if (state[0] != static_cast<double>(clusters) || state.size() < 2 + 3 * count) return std::nullopt;
  shares.clusters_ = clusters;
  for (std::size_t i = 0; i < count; ++i) {
    const double axis = state[3 + 3 * i], second = state[4 + 3 * i];
    const bool isLeaf = axis == 3;
    const bool isWhole = (axis == 0 || axis == 1 || axis == 2 || isLeaf) && second >= 0 && second <= kMost;
    if (!isWhole) return std::nullopt;
    // Children come later: no walk is without an end.
    if (isLeaf ? second != static_cast<double>(shares.cells_)
               : !(second > static_cast<double>(i + 1) && second < static_cast<double>(count)))
      return std::nullopt;
    if (isLeaf) ++shares.cells_;
    shares.nodes_.push_back(
        {state[2 + 3 * i], static_cast<std::uint32_t>(axis), static_cast<std::uint32_t>(second)});
  }
  if (shares.nodes_.back().axis != 3 || state.size() != 2 + 3 * count + shares.cells_ * clusters)
    return std::nullopt;
  shares.factors_.assign(state.begin() + static_cast<std::ptrdiff_t>(2 + 3 * count), state.end());
  for (const double f : shares.factors_) {
    if (!(f > 0) || !std::isfinite(f)) return std::nullopt;
  }
  return shares;
}

}  // namespace pbrtmedia
