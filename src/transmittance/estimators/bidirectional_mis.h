// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/parameters.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/upper_control.h"

namespace pbrtmedia {

/// Bidirectional multiple importance sampling: one walk from a and one from b, every sorted concatenation of
/// their beginnings, and ratio tracking from a, joined by the balance heuristic. A set of k points with gaps
/// g_0..g_k between neighbours (a and b included, in optical depth of the majorant) has density e^{g_t} times
/// that of ratio tracking when its first t points come from a and the others from b, so whoever made it, it
/// scores
///   R / (1 + sum_t e^{g_t}),  R = prod mu_n / majorant.
/// Georgiev et al. 2019, section 5.4; here with piecewise constant majorants, one weight per channel, and the
/// walks taking their steps in turn, so that dimensions of a pattern keep their meaning.
///
/// Bias: none, wherever the bounds are positive. Range: >= 0 while bounds hold, and may exceed 1. Variance:
/// finite for any positive bounds. Cost: 2 tau_bar look-ups on average, less where the weights reach exactly
/// 0. Arithmetic: a division for each pair (beginning from a, beginning from b) that can change the sum's
/// last digit. Those lie within a gap of 38 + ln(points) or so, whatever the bounds: about as dear as the
/// look-ups. Memory: a record per look-up.
struct BidirectionalMis {
  static constexpr std::string_view kName = "bidirectional-mis";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &BidirectionalMis::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary =
                "every join of a walk from the start and a walk from the end, weighted by how likely each is",
            .source = "Georgiev et al. 2019, section 5.4",
            .useWhen = "bounds are tight and variance counts more than time",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = true,
            .control = EstimatorTraits::Control::Any,
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    UpperControl<Line, N> control(line, sigmaT, stream, estimate.tally);
    const double depth = control.depth();
    if (!(depth > 0)) return estimate;
    const LookupLimit limit(maxLookups);
    alignas(Prefix<N>) std::array<std::byte, 64 * sizeof(Prefix<N>)> buffer;
    std::pmr::monotonic_buffer_resource memory(buffer.data(), buffer.size());
    Walk<N> fromA(&memory), fromB(&memory);
    while (!fromA.ended || !fromB.ended) {
      if (!fromA.ended) {
        fromA.step(stream.exponential(), depth, limit, estimate.tally,
                   [&](double x) { return control.nullRatio(x); });
      }
      if (!fromB.ended) {
        fromB.step(stream.exponential(), depth, limit, estimate.tally,
                   [&](double y) { return control.nullRatio(depth - y); });
      }
    }
    estimate.value = filled<N>(0);
    addJoins(estimate.value, fromA, fromB, depth);
    if (fromA.arrived) addRatio(estimate.value, fromA.prefixes.back(), depth);
    return estimate;
  }

 private:
  /// The first points of a walk.
  template <std::size_t N>
  struct Prefix {
    double depth = 0;    ///< of its last point, from the walk's start
    double gapExp = 1;   ///< e^gap of the gap before its last point
    double gapSum = 0;   ///< sum of e^gap over the gaps before its points
    Channels<N> weight;  ///< product of the null ratios: weight 2^exponent
    std::array<std::int64_t, N> exponent;
    double logLargest = 0;  ///< ln of the largest |product|
    double logTail = 0;     ///< ln of the sum of all largest |products| up to here times e^-distance to here
  };

  template <std::size_t N>
  struct Walk {
    std::pmr::vector<Prefix<N>> prefixes;  ///< of 0, 1, 2, ... points
    ChannelProducts<N> product;
    bool ended = false, arrived = false;

    explicit Walk(std::pmr::memory_resource* memory) : prefixes(memory) {
      push({.weight = {}, .exponent = {}});
    }

    template <class NullRatio>
    void step(double gap, double depth, const LookupLimit& limit, LookupTally& tally, NullRatio&& nullRatio) {
      const double at = prefixes.back().depth + gap;
      arrived = at >= depth;
      ended = arrived || limit.reached(tally);
      if (ended) return;
      product.multiply(nullRatio(at));
      ++tally.nullCollisions;
      ended = product.magnitude() == 0;
      if (ended) return;
      const double gapExp = std::exp(gap);
      push({.depth = at,
            .gapExp = gapExp,
            .gapSum = prefixes.back().gapSum + gapExp,
            .weight = {},
            .exponent = {}});
    }
    void push(Prefix<N> prefix) {
      prefix.logLargest = -std::numeric_limits<double>::infinity();
      for (std::size_t c = 0; c < N; ++c) {
        prefix.weight[c] = product[c].mantissa();
        prefix.exponent[c] = product[c].exponent();
        prefix.logLargest = std::max(prefix.logLargest, product[c].logMagnitude());
      }
      prefixes.push_back(prefix);
    }
    /// Fills in logTail.
    void sumTails() {
      double tail = -std::numeric_limits<double>::infinity(), before = 0;
      for (Prefix<N>& p : prefixes) {
        const double carried = tail - (p.depth - before), larger = std::max(carried, p.logLargest);
        tail = larger + std::log1p(std::exp(std::min(carried, p.logLargest) - larger));
        p.logTail = tail;
        before = p.depth;
      }
    }
  };

  /// All pairs of beginnings that do not overlap, the narrowest gaps first. Of each beginning from a, wider
  /// gaps are left out where all that they still could add, at most |R| e^{-gap} each, is lost in the
  /// rounding of every channel's sum.
  template <std::size_t N>
  static void addJoins(Channels<N>& sum, const Walk<N>& fromA, Walk<N>& fromB, double depth) {
    fromB.sumTails();
    const auto rows = static_cast<double>(fromA.prefixes.size());
    constexpr double kRounding = 0x1p-55, kNothingLeft = -800;  // of e^x in double
    Channels<N> size{};                                         // sums of absolute values
    const auto begin = fromB.prefixes.cbegin();
    auto end = fromB.prefixes.cend();
    for (const Prefix<N>& a : fromA.prefixes) {
      while (end != begin && !(a.depth < depth - (end - 1)->depth)) --end;
      if (end == begin) return;
      const double visible =
          std::max(kNothingLeft, std::log(*std::min_element(size.begin(), size.end()) * kRounding / rows));
      double gapExp = std::exp(depth - (end - 1)->depth - a.depth);
      for (auto b = end; b != begin;) {
        --b;
        const double gap = depth - b->depth - a.depth;
        if (a.logLargest + b->logTail - gap < visible) break;
        const double others = 1 + a.gapSum + b->gapSum;
        for (std::size_t c = 0; c < N; ++c) {
          const double term =
              scoreOf(a.weight[c] * b->weight[c], a.exponent[c] + b->exponent[c], others, gap, gapExp);
          addTerm(sum[c], term);
          addTerm(size[c], std::abs(term));
        }
        gapExp *= b->gapExp;  // the next gap is wider by this one
      }
    }
  }
  /// The ratio tracking technique's share of the whole walk from a.
  template <std::size_t N>
  static void addRatio(Channels<N>& sum, const Prefix<N>& whole, double depth) {
    for (std::size_t c = 0; c < N; ++c) {
      const double gap = depth - whole.depth;
      addTerm(sum[c], scoreOf(whole.weight[c], whole.exponent[c], 1 + whole.gapSum, gap, std::exp(gap)));
    }
  }
  /// mantissa 2^exponent / (others + e^gap), from the exponents' difference where a part has no double.
  /// gapExp: e^gap or, beyond the range of double, infinite.
  static double scoreOf(double mantissa, std::int64_t exponent, double others, double gap, double gapExp) {
    constexpr double kLn2 = 0.69314718055994530942, kWideGap = 600;
    if (exponent == 0 && gap < kWideGap) [[likely]] {
      return mantissa / (others + gapExp);
    }
    if (mantissa == 0) return 0;
    // others + e^gap = e^gap (1 + others e^-gap)
    return mantissa / (1 + others * std::exp(-gap)) * std::exp(static_cast<double>(exponent) * kLn2 - gap);
  }
};

}  // namespace pbrtmedia
