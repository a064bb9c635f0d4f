// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "integrators/sppm/photon_kernel.h"

namespace pbrtmedia {

/// What is done about the bias of kernels.
enum class Debias : std::uint8_t {
  None,                ///< radii shrink by the photons found (PixelRadii)
  Single,              ///< unbiased: one random term of the bias in each iteration, the kernel stays
  Progressive,         ///< kernels shrink from one iteration to the next, the same in all pixels
  ProgressiveUnbiased  ///< these, with one random term of the bias that each still has
};

/// Kernels and photons of the iterations of debiased photon mapping. The size of kernel number n = 1, 2, ...
/// is n^(alpha - 1) of the first, and the bias of number k is the sum over n >= k of I(n + 1) - I(n), what
/// the next kernel finds less what this one finds. One of these terms is taken over its probability:
/// Pr{n or beyond} = n^(alpha - 1), which is of the order of the terms. It gets (n + 1)^(1 - c alpha) times
/// the photons, which all kernels of the iteration share. Misso et al. 2022,
/// doi:10.1145/3528223.3530160, section 5.3 and appendix C; Knaus & Zwicker 2011,
/// doi:10.1145/1966394.1966404.
///
/// Unbiased whatever alpha, c and limit of photons, as levels end. Without that end the mean size of a
/// correction over its probability is finite for c < 1 only: its terms go as n^(-1 + (c - 1) alpha / 2).
/// Expected photons are finite for c > 1 (the paper's 1.001), the variance for c < (2 alpha - 1) / alpha (the
/// 0.499 of its code, for alpha = 2/3): never both, and the limit of photons makes the first of the second.
class KernelSchedule {
 public:
  static constexpr double kAlpha = 2.0 / 3, kC = 1.001;
  struct Params {
    Debias debias = Debias::None;  ///< None: all kernels are the first
    double alpha = kAlpha;         ///< in (0, 1)
    double c = kC;                 ///< > 0
  };
  explicit KernelSchedule(const Params& params) : params_(params) {}

  struct Step {
    KernelSizes sizes;
    double photons = 1;  ///< times those of the first level, >= 1; may be infinite
  };
  /// Of iteration 0, 1, ... `u`: uniform in [0, 1).
  Step of(std::int64_t iteration, double u) const;

 private:
  Params params_;
};

}  // namespace pbrtmedia
