// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/photon_kernel.h"

#include <cmath>
#include <numbers>

namespace pbrtmedia {

template <int kDimensions>
PhotonKernel<kDimensions>::PhotonKernel(KernelShape shape, float radius, const KernelSizes& sizes)
    : isUniform_(shape == KernelShape::Uniform && !sizes.correction),
      radius_(double{radius} * std::pow(sizes.base, 1.0 / kDimensions)),
      base_(shapeOf(shape)) {
  if (!sizes.correction) return;
  const KernelSizes::Correction& by = *sizes.correction;
  outer_ = double{radius} * std::pow(by.size, 1.0 / kDimensions);
  inner_ = outer_ * std::exp(by.logRatio / kDimensions);
  // A term x^m of a kernel of radius r goes by r^-(dimensions + m): the inner kernel less the outer one is
  // the outer one's term times exp(-(dimensions + m) log(inner / outer)) - 1.
  const double scale = sizes.base / (by.size * by.probability);
  for (std::size_t m = 0; m < kTerms; ++m) {
    const double power = static_cast<double>(kDimensions + m) / kDimensions;
    withinInner_[m] = scale * base_[m] * std::expm1(-power * by.logRatio);
    beyondInner_[m] = -scale * base_[m];
  }
}

template <int kDimensions>
double PhotonKernel<kDimensions>::measure() const {
  if constexpr (kDimensions == 2) return std::numbers::pi * radius_ * radius_;
  return 4 * std::numbers::pi / 3 * radius_ * radius_ * radius_;
}

/// Over its mean in the disc or ball.
template <int kDimensions>
typename PhotonKernel<kDimensions>::Polynomial PhotonKernel<kDimensions>::shapeOf(KernelShape shape) {
  constexpr std::array<Polynomial, 4> kShapes = {
      {{1, 0, 0, 0, 0}, {1, -1, 0, 0, 0}, {1, 0, -1, 0, 0}, {1, 0, -2, 0, 1}}};
  Polynomial p = kShapes[static_cast<std::size_t>(shape)];
  double mean = 0;
  for (std::size_t m = 0; m < kTerms; ++m) mean += p[m] * kDimensions / static_cast<double>(kDimensions + m);
  for (double& term : p) term /= mean;
  return p;
}

template <int kDimensions>
double PhotonKernel<kDimensions>::valueOf(const Polynomial& p, double x) {
  double value = 0;
  for (std::size_t m = kTerms; m-- > 0;) value = value * x + p[m];
  return value;
}

template <int kDimensions>
double PhotonKernel<kDimensions>::weight(float distance2) const {
  const double distance = std::sqrt(double{distance2});
  const double base = valueOf(base_, distance / radius_);
  if (!(distance <= outer_)) return base;
  return base + valueOf(distance <= inner_ ? withinInner_ : beyondInner_, distance / outer_);
}

template class PhotonKernel<2>;
template class PhotonKernel<3>;

}  // namespace pbrtmedia
