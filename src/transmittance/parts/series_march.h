// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string_view>
#include <vector>

#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/comb_integrator.h"
#include "transmittance/parts/comb_size.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/power_series.h"
#include "transmittance/parts/term_roulette.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// What Bhanot-Kennedy, U-BK and unbiased ray marching have in common: transmittance as the power series of
/// exp about a pivot, each factor an independent estimate of the optical depth from one comb, the number of
/// terms by roulette. The integral of the density is estimated once for all channels; each channel has its
/// own series. The largest channel's control chooses cost and roulette.
///
/// Look-ups: N combs, one more with a sampled pivot; nothing in vacuum that is proven. The control is
/// majorant minus minorant: where it is 0 (a constant medium) one look-up a comb is left, and it is exact.
struct SeriesMarch {
  static constexpr std::string_view kPivotHelp =
      "where the series is expanded: at the majorant's optical depth, a fixed one, or a sampled one";
  static constexpr std::string_view kPivotDepthHelp =
      "optical depth of the fixed pivot, in the largest channel";
  static constexpr std::string_view kRouletteHelp =
      "how many terms: aggressive (mostly the first alone), bk (c certain, then c/k), cmf (p-series CMF), "
      "cumulative (by the size of the terms), none (c terms, biased)";
  static constexpr std::string_view kZeroOrderHelp = "aggressive roulette: how often the first term is all";
  static constexpr std::string_view kExpansionHelp =
      "c: terms up to it are certain, then they go on with c/k; 0: the control's optical depth, at least 1";
  static constexpr std::string_view kMeansHelp =
      "of symmetrised products: exact, or as in the code published with Misso et al. 2023 (published), "
      "biased";
  static constexpr std::string_view kTupleSizeHelp =
      "look-ups of one comb; 0: so that the mean cost is that of p-series CMF";

  Pivot pivot = Pivot::Sampled;
  double pivotDepth = 1;
  bool isSymmetrised = true;
  ElementaryMeans means = ElementaryMeans::Exact;
  Roulette roulette = Roulette::Aggressive;
  double zeroOrderProbability = 0.9;
  double expansion = 2;  ///< 0: the control's depth, at least 1
  CombSettings comb;
  std::uint64_t tupleSize = 0;  ///< 0: automatic
  std::uint64_t mostTeeth = 0;
  LookupLimit limit = LookupLimit(0);
  bool checksBounds = false;  ///< even where they are proven

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return estimate;
    const BoundProfile profile(line);
    if (!(profile.length() > 0) || (line.hasProvenBounds() && !(profile.upper() > 0))) return estimate;
    // Beyond kOpaque nothing distinguishes controls any more, but infinity would not be a number of teeth.
    constexpr double kOpaque = 1e15;
    const double control = std::min(sigmaMax * profile.excess(), kOpaque);
    const OrderRoulette orders = ordersFor(control, line.hasProvenBounds());
    CombIntegrator<Line> combs(line, profile, comb, teethFor(control, orders),
                               checksBounds || !line.hasProvenBounds(), stream, estimate.tally);
    const double given = pivot == Pivot::Majorant ? profile.upper() : pivotDepth / sigmaMax;
    if (roulette == Roulette::Cumulative) {
      estimate.value = cumulative(sigmaT, pivotOr(given, combs), combs, stream, estimate.tally);
      return estimate;
    }
    const std::uint64_t order = orders.draw(stream.uniformAboveZero());
    if (order == 0) {
      const double column = pivotOr(given, combs);
      for (std::size_t c = 0; c < N; ++c) estimate.value[c] = std::exp(-sigmaT[c] * column);
    } else if (isSymmetrised && isAffordable(order)) {
      symmetric(sigmaT, given, static_cast<std::size_t>(order), orders, combs, estimate.value);
    } else {
      estimate.value = plain(sigmaT, pivotOr(given, combs), order, orders, combs, estimate.tally);
    }
    return estimate;
  }

  static void markTruncated(EstimatorTraits& traits) {
    traits.bias = EstimatorTraits::Bias::Consistent;
    traits.biasNote =
        "without roulette the terms beyond the expansion are missing; falls with the combs' noise";
  }

  /// Teeth of each comb, and the law of the number of terms, under a control of this depth.
  std::uint64_t teethFor(double control, const OrderRoulette& orders) const {
    if (tupleSize > 0) return teethOf(static_cast<double>(tupleSize), mostTeeth);
    // The cumulative roulette goes by values still unknown: one term about a sampled pivot, the control's
    // depth more elsewhere.
    const double expected = roulette != Roulette::Cumulative ? orders.expectedOrder()
                            : pivot == Pivot::Sampled        ? 1
                                                             : 1 + control;
    return tupleSizeFor(control, expected, mostTeeth);
  }
  OrderRoulette ordersFor(double control, bool isProven) const {
    const double c = expansion > 0 ? expansion : std::max(control, 1.0);
    switch (roulette) {
      case Roulette::Aggressive:
        return OrderRoulette::aggressive(c, zeroOrderProbability);
      case Roulette::Cmf:
        // An unproven control of 0 says nothing, and must not end the series.
        return OrderRoulette::cmf(control > 0 || isProven ? control : 1);
      case Roulette::None:
        return OrderRoulette::truncated(c);
      case Roulette::BhanotKennedy:
      case Roulette::Cumulative:
        break;
    }
    return OrderRoulette::bhanotKennedy(c);
  }

 private:
  /// Beyond this many operations the series takes plain products: minutes would be too long. The choice hangs
  /// on the order alone, so it biases nothing.
  static constexpr double kMostOperations = 0x1p24;
  bool isAffordable(std::uint64_t order) const {
    const double n = static_cast<double>(order);
    return n * n * (pivot == Pivot::Sampled ? n + 1 : 1) / 2 <= kMostOperations;
  }

  template <class Combs>
  double pivotOr(double given, Combs& combs) const {
    return pivot == Pivot::Sampled ? combs.integral() : given;
  }

  template <class Combs, std::size_t N>
  void symmetric(const Channels<N>& sigmaT, double given, std::size_t order, const OrderRoulette& orders,
                 Combs& combs, Channels<N>& value) const {
    alignas(double) std::array<std::byte, 32 * sizeof(double)> buffer;
    std::pmr::monotonic_buffer_resource memory(buffer.data(), buffer.size());
    std::pmr::vector<double> columns(order + (pivot == Pivot::Sampled ? 1 : 0), &memory);
    for (double& column : columns) column = combs.integral();
    if (pivot == Pivot::Sampled) {
      symmetricSeriesAboutEach(columns, orders, sigmaT, value, means);
    } else {
      symmetricSeries(columns, given, orders, sigmaT, value, means);
    }
  }

  template <class Combs, std::size_t N>
  Channels<N> plain(const Channels<N>& sigmaT, double about, std::uint64_t order, const OrderRoulette& orders,
                    Combs& combs, LookupTally& tally) const {
    ProductSeries<N> series(sigmaT, about);
    for (std::uint64_t k = 1; k <= order && !limit.reached(tally); ++k) {
      series.multiply(combs.integral(), orders.termFactor(k));
      series.addTerm();
    }
    return series.value();
  }

  template <class Combs, std::size_t N>
  Channels<N> cumulative(const Channels<N>& sigmaT, double about, Combs& combs, SampleStream& stream,
                         LookupTally& tally) const {
    ProductSeries<N> series(sigmaT, about);
    for (std::uint64_t k = 1; !limit.reached(tally); ++k) {
      series.multiply(combs.integral(), 1 / static_cast<double>(k));
      const double survival = survivalFactor(series.largestTerm(), stream);
      if (!(survival > 0)) break;
      series.multiply(survival);
      series.addTerm();
    }
    return series.value();
  }
};

}  // namespace pbrtmedia
