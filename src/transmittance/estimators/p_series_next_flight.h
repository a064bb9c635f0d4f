// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/interruption.h"
#include "base/parameters.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson.h"
#include "transmittance/parts/upper_control.h"

namespace pbrtmedia {

/// P-series next-flight estimation: a Poisson number k of points, independent and with density proportional
/// to the majorant, and all terms of the power series up to the k-th,
///   T = sum_{j<=k} (Pr{K = j} / Pr{K >= j}) prod_{i<=j} mu_n(x_i) / majorant(x_i),  K ~ Poisson(tau_bar),
/// which is Georgiev et al. 2019, Eq. (28), with e^{-tau_bar} tau_bar^j / j! written as a probability. Here
/// with piecewise constant majorants and one weight per channel.
///
/// Bias: none, wherever the bounds are positive. Range: >= 0 while bounds hold, and may exceed 1. Second
/// moment in one channel, with h_j the quotient above, S_j = Pr{K >= j} and r = mu_n / majorant:
/// sum_{j,l} h_j h_l S_max(j,l) E[r^2]^min(j,l) E[r]^|j-l|; finite for any positive bounds. Cost: tau_bar
/// look-ups on average, less where the weights reach exactly 0. Memory: a number per look-up.
struct PSeriesNextFlight {
  static constexpr std::string_view kName = "p-series-next-flight";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &PSeriesNextFlight::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {
        .summary = "all terms of the power series up to a random order, each over its chance to be reached",
        .source = "Georgiev et al. 2019 (28)",
        .useWhen = "bounds are tight and the estimates of a pixel share a stratified pattern",
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
    std::uint64_t order = poissonQuantile(stream.uniform(), depth);
    const LookupLimit limit(maxLookups);
    if (maxLookups > 0 && order > maxLookups) order = maxLookups, estimate.tally.capped = 1;

    ChannelProducts<N> weight;
    estimate.value = filled<N>(0);
    const auto lookUp = [&] {
      weight.multiply(control.nullRatio(stream.uniform() * depth));
      return weight.magnitude() > 0;
    };
    const std::uint64_t first = std::min(order, firstOrderThatCounts(depth));
    for (std::uint64_t j = 0; j < first; ++j) {
      if (!lookUp()) return estimate;
    }
    std::array<double, 64> buffer;
    std::pmr::monotonic_buffer_resource memory(buffer.data(), sizeof buffer);
    const auto hazards = hazardsDown(order, first, depth, &memory);
    for (std::uint64_t j = first;; ++j) {
      for (std::size_t c = 0; c < N; ++c) {
        addTerm(estimate.value[c], weight[c].times(hazards[order - j]));
      }
      if (j == order || !lookUp()) return estimate;
    }
  }

  /// Pr{K = j} / Pr{K >= j} of K ~ Poisson(mean), mean > 0, for j = last, last - 1, ..., first. By
  /// 1/h_j = 1 + mean/(j+1) / h_{j+1}, a sum of positive numbers: no cancellation, no factorial, no
  /// e^{-mean}; 0 where no double is left. Relative error: a few 1e-16 times the terms that matter.
  static std::pmr::vector<double> hazardsDown(std::uint64_t last, std::uint64_t first, double mean,
                                              std::pmr::memory_resource* memory) {
    std::pmr::vector<double> hazards(memory);
    hazards.reserve(last - first + 1);
    double inverse = 1, term = 1;  // 1/h_last = 1 + mean/(last+1) (1 + mean/(last+2) (1 + ...))
    for (double j = static_cast<double>(last) + 1; !std::isinf(inverse); ++j) {
      leaveIfAbandoned();
      term *= mean / j;
      inverse += term;
      if (term <= inverse * 1e-18 && mean < j) break;
    }
    for (std::uint64_t j = last;; --j) {
      hazards.push_back(1 / inverse);
      if (j == first) return hazards;
      inverse = 1 + mean / static_cast<double>(j) * inverse;
    }
  }

  /// Below it Pr{K = j} <= exp(-x^2 / 2) with x = 40 is less than the smallest double.
  static std::uint64_t firstOrderThatCounts(double mean) {
    const double order = std::floor(mean - 40 * std::sqrt(mean));
    return order > 0 ? static_cast<std::uint64_t>(order) : 0;
  }
};

}  // namespace pbrtmedia
