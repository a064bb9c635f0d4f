// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/parameters.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/order_roulette.h"
#include "transmittance/parts/scaled_double.h"

namespace pbrtmedia {

/// Where the power series of exp is expanded.
enum class Pivot {
  Majorant,  ///< at the optical depth of the upper bounds
  Fixed,     ///< at an optical depth the user gives (in the largest channel)
  Sampled    ///< at an estimate of the optical depth, from one comb more
};
template <>
inline constexpr std::array kChoices<Pivot>{std::string_view("majorant"), std::string_view("fixed"),
                                            std::string_view("sampled")};

/// How the number of terms is drawn, see OrderRoulette. Cumulative: term by term, going on with the term's
/// own size, at most 1 (Georgiev et al. 2019 (30)). None: no roulette, a truncated and biased series.
enum class Roulette { Aggressive, BhanotKennedy, Cmf, Cumulative, None };
template <>
inline constexpr std::array kChoices<Roulette>{std::string_view("aggressive"), std::string_view("bk"),
                                               std::string_view("cmf"), std::string_view("cumulative"),
                                               std::string_view("none")};

/// The elementary symmetric means of a series: exact, or for comparison as the code published with Misso et
/// al. 2023 computes them, which leaves out the first factor of every mean and divides by the number of all
/// factors where the number of those so far belongs. That is biased.
enum class ElementaryMeans { Exact, Published };
template <>
inline constexpr std::array kChoices<ElementaryMeans>{std::string_view("exact"),
                                                      std::string_view("published")};

/// Partial sums of exp(-sigma_c P) sum_k prod_{i <= k} sigma_c (P - F_i) w_i, one factor after the other: the
/// series with plain products, where P is the pivot and F_i are independent estimates of the integral of the
/// density. No term leaves its range.
template <std::size_t N>
class ProductSeries {
 public:
  ProductSeries(const Channels<N>& sigmaT, double pivot) : sigmaT_(sigmaT), pivot_(pivot) {
    term_.fill(1.0);
    sum_.fill(1.0);
  }
  /// The next term is the last one times sigma_c (P - column) weight.
  void multiply(double column, double weight) {
    for (std::size_t c = 0; c < N; ++c) term_[c] *= ScaledDouble(sigmaT_[c] * (pivot_ - column)) * weight;
  }
  void multiply(double factor) {
    for (ScaledDouble& t : term_) t *= factor;
  }
  void addTerm() {
    for (std::size_t c = 0; c < N; ++c) sum_[c] += term_[c];
  }
  /// Size of the term in its largest channel, without exp(-sigma_c P).
  double largestTerm() const {
    double largest = 0;
    for (const ScaledDouble& t : term_) largest = std::max(largest, std::abs(t.value()));
    return largest;
  }
  Channels<N> value() const {
    Channels<N> result;
    for (std::size_t c = 0; c < N; ++c) {
      result[c] = (sum_[c] * ScaledDouble::exp(-sigmaT_[c] * pivot_)).value();
    }
    return result;
  }

 private:
  Channels<N> sigmaT_;
  double pivot_;
  std::array<ScaledDouble, N> term_, sum_;
};

/// The symmetrised series: products replaced by elementary symmetric means of all N estimates. With a fixed
/// pivot P: exp(-sigma P) sum_k sigma^k m_k(P - F_1, .., P - F_N) / (k! P_k), Kettunen et al. 2021 (24) and
/// (26). `columns` are F_1 .. F_N; out[c] is the value for sigmaT[c]. Cost N^2.
void symmetricSeries(std::span<const double> columns, double pivot, const OrderRoulette& roulette,
                     std::span<const double> sigmaT, std::span<double> out,
                     ElementaryMeans means = ElementaryMeans::Exact);
/// With N + 1 estimates, each in turn the pivot of the others: the mean of these. Kettunen et al. 2021 (31).
/// Cost N^3.
void symmetricSeriesAboutEach(std::span<const double> columns, const OrderRoulette& roulette,
                              std::span<const double> sigmaT, std::span<double> out,
                              ElementaryMeans means = ElementaryMeans::Exact);

}  // namespace pbrtmedia
