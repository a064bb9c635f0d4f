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

}  // namespace pbrtmedia
