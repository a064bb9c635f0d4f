// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pbrtmedia::test {

/// Chandrasekhar's H function of isotropic scattering with single-scattering albedo 0 <= w <= 1:
/// 1/H(mu) = sqrt(1 - w) + (w/2) int_0^1 x H(x) / (x + mu) dx (Radiative Transfer, 1960, Sec. 41, in the form
/// that converges for every albedo), iterated on Gauss-Legendre points until it stands still. About 1e-9.
class ChandrasekharH {
 public:
  explicit ChandrasekharH(double albedo) : albedo_(albedo) {
    constexpr int kPoints = 200;
    for (int i = 0; i < kPoints; ++i) {  // roots of the Legendre polynomial by Newton's method
      double x = std::cos(M_PI * (i + 0.75) / (kPoints + 0.5)), slope = 1;
      for (int step = 0; step < 50; ++step) {
        double p0 = 1, p1 = x;
        for (int n = 2; n <= kPoints; ++n) {
          const double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
          p0 = p1;
          p1 = p2;
        }
        slope = kPoints * (x * p1 - p0) / (x * x - 1);
        const double move = p1 / slope;
        x -= move;
        if (std::abs(move) < 1e-16) break;
      }
      x_.push_back((1 + x) / 2);
      weight_.push_back(1 / ((1 - x * x) * slope * slope));
    }
    h_.assign(x_.size(), 1);
    for (int step = 0; step < 100000; ++step) {
      std::vector<double> next(h_.size());
      double change = 0;
      for (std::size_t i = 0; i < h_.size(); ++i) {
        next[i] = (*this)(x_[i]);
        change = std::max(change, std::abs(next[i] - h_[i]));
      }
      h_ = std::move(next);
      if (change < 1e-13) break;
    }
  }

  /// 0 < mu <= 1: cosine to the normal.
  double operator()(double mu) const {
    double sum = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) sum += weight_[i] * x_[i] * h_[i] / (x_[i] + mu);
    return 1 / (std::sqrt(1 - albedo_) + albedo_ / 2 * sum);
  }

 private:
  double albedo_;
  std::vector<double> x_, weight_, h_;
};

/// Radiance that a half-space of isotropic scatterers sends back under the cosine mu when radiance 1 arrives
/// from everywhere.
inline double halfSpaceRadiance(double albedo, double mu) {
  return 1 - ChandrasekharH(albedo)(mu) * std::sqrt(1 - albedo);
}

}  // namespace pbrtmedia::test
