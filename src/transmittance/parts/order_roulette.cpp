// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/order_roulette.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/interruption.h"
#include "transmittance/parts/poisson.h"

namespace pbrtmedia {
namespace {

constexpr std::array<double, 64> kInverses = [] {
  std::array<double, 64> inverses{};
  for (std::size_t k = 1; k < inverses.size(); ++k) inverses[k] = 1 / static_cast<double>(k);
  return inverses;
}();

std::uint64_t floorOf(double c) { return static_cast<std::uint64_t>(c); }

}  // namespace

OrderRoulette OrderRoulette::bhanotKennedy(double c) { return {floorOf(c), c, 1}; }
OrderRoulette OrderRoulette::aggressive(double c, double zeroOrder) { return {floorOf(c), c, 1 - zeroOrder}; }
OrderRoulette OrderRoulette::truncated(double c) { return {floorOf(c), 0, 1}; }

OrderRoulette OrderRoulette::cmf(double depth) {
  constexpr double kShare = 0.99;
  // The smallest j with Pr{<= j} >= 0.99 is k - 2 for the first k that is not certain.
  return {poissonQuantile(kShare, depth) + 1, depth, 1};
}

std::uint64_t OrderRoulette::draw(double u) const {
  if (certain > 0 && beyondZero < u) return 0;
  double probability = certain > 0 ? beyondZero : 1;
  std::uint64_t order = certain;
  for (; (probability *= continuation(order + 1)) >= u; ++order) leaveIfAbandoned();
  return order;
}

double OrderRoulette::expectedOrder() const {
  double probability = certain > 0 ? beyondZero : 1;
  double sum = certain > 0 ? static_cast<double>(certain) * beyondZero : 0;
  constexpr double kNegligible = 1e-17;
  for (std::uint64_t k = certain + 1;; ++k) {
    leaveIfAbandoned();
    // Asked for at every estimate, so without a division for the orders that matter.
    const double next = k < kInverses.size() ? expansion * kInverses[k] : expansion / static_cast<double>(k);
    probability *= k == 1 ? beyondZero * std::min(next, 1.0) : std::min(next, 1.0);
    if (!(probability > kNegligible * sum)) return sum;
    sum += probability;
  }
}

}  // namespace pbrtmedia
