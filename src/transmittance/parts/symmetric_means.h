// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>

namespace pbrtmedia {

/// Elementary symmetric means of x_1 .. x_N: m_k is the mean of the products of all C(N, k) choices of k of
/// them, the U-statistic of a product of k independent estimates. Fills means[k], k = 0 .. means.size() - 1
/// <= N, with m_k / scale^k and returns scale, the mean of |x_i|; by Maclaurin's inequality none of them
/// exceeds
/// 1. (All x 0: scale 0 and m_k = 0 for k > 0.) Kettunen et al. 2021, algorithm 1: every step is a convex
/// combination, so no digits cancel when all x have one sign, unlike Girard-Newton sums of powers. Relative
/// error then below about N 2^-52. Cost: N * means.size().
double elementarySymmetricMeans(std::span<const double> x, std::span<double> means);
/// What the code published with Misso et al. 2023 computes in their place, scaled in the same way: for n = 1
/// .. N and k = n - 1 down to 1, m_k += k / N (m_{k-1} x_n - m_k). So no product has x_1, and none has all of
/// them. Only for comparison: the series is biased with it.
double publishedSymmetricMeans(std::span<const double> x, std::span<double> means);
/// The products of the first k of x_1 .. x_N: means[k] = x_1 .. x_k / scale^k with the same scale.
double leadingProducts(std::span<const double> x, std::span<double> products);

}  // namespace pbrtmedia
