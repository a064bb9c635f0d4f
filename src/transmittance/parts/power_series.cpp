// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/power_series.h"

#include <algorithm>
#include <memory_resource>
#include <vector>

#include "transmittance/parts/symmetric_means.h"

namespace pbrtmedia {
namespace {

/// Working memory for orders up to some dozens without the heap.
class Scratch {
 public:
  Scratch() : memory_(buffer_.data(), buffer_.size()) {}
  std::pmr::memory_resource* resource() { return &memory_; }

 private:
  alignas(ScaledDouble) std::array<std::byte, 2048> buffer_;
  std::pmr::monotonic_buffer_resource memory_;
};

/// What term k has more than term k - 1, for k = 1 .. factors.size().
void fillFactors(const OrderRoulette& roulette, std::span<double> factors) {
  for (std::size_t k = 1; k <= factors.size(); ++k) factors[k - 1] = roulette.termFactor(k);
}

/// sum_k y^k means[k] / (k! P_k). A term too small for a double is nothing beside the first, which is 1; so
/// double is enough until one is too large.
ScaledDouble sumOfTerms(double y, std::span<const double> means, std::span<const double> factors) {
  constexpr double kLarge = 1e200;
  double power = 1, sum = 1, largest = 1;
  for (std::size_t k = 1; k < means.size(); ++k) {
    power *= y * factors[k - 1];
    sum += power * means[k];
    largest = std::max(largest, power);
  }
  if (largest < kLarge) return sum;
  ScaledDouble scaledPower = 1, scaledSum = 1;
  for (std::size_t k = 1; k < means.size(); ++k) {
    scaledPower *= y * factors[k - 1];
    scaledSum += scaledPower * means[k];
  }
  return scaledSum;
}

/// sums[c] += exp(-sigmaT[c] pivot) sum_k sigmaT[c]^k m_k(differences) / (k! P_k).
void addSeries(std::span<const double> differences, double pivot, std::span<const double> factors,
               std::span<const double> sigmaT, ElementaryMeans kind, std::span<double> means,
               std::span<ScaledDouble> sums) {
  const double scale = kind == ElementaryMeans::Exact ? elementarySymmetricMeans(differences, means)
                                                      : publishedSymmetricMeans(differences, means);
  for (std::size_t c = 0; c < sigmaT.size(); ++c) {
    const double y = sigmaT[c] * scale;
    const ScaledDouble atPivot = ScaledDouble::exp(-sigmaT[c] * pivot);
    sums[c] += y > 0 ? sumOfTerms(y, means, factors) * atPivot : atPivot;
  }
}

}  // namespace

void symmetricSeries(std::span<const double> columns, double pivot, const OrderRoulette& roulette,
                     std::span<const double> sigmaT, std::span<double> out, ElementaryMeans kind) {
  Scratch scratch;
  std::pmr::vector<double> differences(columns.size(), scratch.resource());
  std::pmr::vector<double> means(columns.size() + 1, scratch.resource());
  std::pmr::vector<double> factors(columns.size(), scratch.resource());
  std::pmr::vector<ScaledDouble> sums(sigmaT.size(), scratch.resource());
  for (std::size_t i = 0; i < columns.size(); ++i) differences[i] = pivot - columns[i];
  fillFactors(roulette, factors);
  addSeries(differences, pivot, factors, sigmaT, kind, means, sums);
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = sums[c].value();
}

void symmetricSeriesAboutEach(std::span<const double> columns, const OrderRoulette& roulette,
                              std::span<const double> sigmaT, std::span<double> out, ElementaryMeans kind) {
  Scratch scratch;
  std::pmr::vector<double> differences(columns.size() - 1, scratch.resource());
  std::pmr::vector<double> means(columns.size(), scratch.resource());
  std::pmr::vector<double> factors(columns.size() - 1, scratch.resource());
  std::pmr::vector<ScaledDouble> sums(sigmaT.size(), scratch.resource());
  fillFactors(roulette, factors);
  for (std::size_t p = 0; p < columns.size(); ++p) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      differences[i] = columns[p] - columns[i < p ? i : i + 1];
    }
    addSeries(differences, columns[p], factors, sigmaT, kind, means, sums);
  }
  for (std::size_t c = 0; c < out.size(); ++c) {
    sums[c] *= 1 / static_cast<double>(columns.size());
    out[c] = sums[c].value();
  }
}

}  // namespace pbrtmedia
