// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/taylor_roulette.h"

#include <cstddef>
#include <vector>

#include "base/interruption.h"
#include "transmittance/parts/scaled_double.h"
#include "transmittance/parts/symmetric_means.h"

namespace pbrtmedia {

std::uint64_t TaylorRoulette::draw(double u) const {
  std::uint64_t order = 0;
  for (double reaching = continuation(1); reaching >= u; reaching *= continuation(order + 1)) {
    leaveIfAbandoned();
    ++order;
  }
  return order;
}

double TaylorRoulette::expectedOrder() const {
  double sum = 0, reaching = 1;
  for (std::uint64_t j = 1; reaching > 1e-17; ++j) {
    leaveIfAbandoned();
    sum += reaching *= continuation(j);
  }
  return sum;
}

void TaylorRoulette::sumAbout(double pivot, std::span<const double> columns, std::span<const double> sigmaT,
                              std::span<double> out) const {
  std::vector<double> differences, means(columns.size() + 1);
  differences.reserve(columns.size());
  for (const double column : columns) differences.push_back(pivot - column);
  const double scale = elementarySymmetricMeans(differences, means);
  for (std::size_t c = 0; c < sigmaT.size(); ++c) {
    const double alpha = sigmaT[c] * pivot;
    ScaledDouble weight = ScaledDouble::exp(law.logarithm(alpha)), sum = weight;
    for (std::uint64_t j = 1; j <= columns.size(); ++j) {
      // Delta_j / Delta_{j-1} without the means, which do not depend on sigma; the sign of alpha - F is
      // theirs.
      weight *= -law.taylorRatio(alpha, static_cast<double>(j)) / continuation(j) * (sigmaT[c] * scale);
      sum += weight * means[j];
    }
    out[c] = sum.value();
  }
}

void TaylorRoulette::sumAboutEach(std::span<const double> columns, std::span<const double> sigmaT,
                                  std::span<double> out) const {
  std::vector<double> others(columns.begin() + 1, columns.end()), one(out.size());
  const double share = 1 / static_cast<double>(columns.size());
  for (double& sum : out) sum = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    sumAbout(columns[i], others, sigmaT, one);
    for (std::size_t c = 0; c < out.size(); ++c) out[c] += one[c] * share;
    if (i < others.size()) others[i] = columns[i];  // the next pivot leaves, this one comes in
  }
}

}  // namespace pbrtmedia
