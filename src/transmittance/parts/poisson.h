// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

namespace pbrtmedia {

// The Poisson distribution of K, mean >= 0 and finite, from 1e-300 to 1e18 without underflow, overflow or
// cancellation. All functions are pure. Cost: at most some ten square roots of the mean, a constant above a
// mean of 1e6.

/// Pr{K = k}. Relative error below 1e-12 wherever it is above 1e-290.
double poissonPmf(std::uint64_t k, double mean);

/// Pr{K <= k} = Q(k + 1, mean), the regularised upper incomplete gamma function. Relative error below 1e-11
/// in both tails of poissonCdf and poissonTail.
double poissonCdf(std::uint64_t k, double mean);

/// Pr{K >= k} = P(k, mean) for k > 0, the regularised lower incomplete gamma function; 1 for k = 0.
double poissonTail(std::uint64_t k, double mean);

/// The smallest k with Pr{K <= k} > u, 0 <= u < 1: the inverse of the distribution function, so a uniform u
/// gives K, and grows with u (stratified u give stratified K). Above a mean of 1e15 k is exact to double
/// precision only.
std::uint64_t poissonQuantile(double u, double mean);

}  // namespace pbrtmedia
