// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace pbrtmedia {

/// How photons weigh by their distance x, as a share of the radius: 1, 1 - x, 1 - x², (1 - x²)².
enum class KernelShape : std::uint8_t { Uniform, Cone, Quadratic, Quartic };

/// Sizes of the kernels of an iteration: areas of discs on surfaces, volumes of balls in media, as shares of
/// that of the first radius.
struct KernelSizes {
  double base = 1;
  /// The difference of the kernel after the one of `size`, which is larger by exp(logRatio) < 1, and that,
  /// over the probability with which this difference is the one taken.
  struct Correction {
    double size, logRatio, probability;
  };
  std::optional<Correction> correction{};
};

/// Weights of photons around a point, on a disc (2 dimensions) or in a ball (3): a kernel whose integral is
/// 1, and a difference of two, whose integral is 0, that corrects its bias. Both see the same photons, so the
/// difference has the noise of one kernel, not of two.
template <int kDimensions>
class PhotonKernel {
 public:
  /// `radius`: that of size 1, world length.
  PhotonKernel(KernelShape shape, float radius, const KernelSizes& sizes = {});

  /// Photons farther away have no weight.
  float radius() const { return static_cast<float>(radius_); }
  /// Area or volume within.
  double measure() const;
  /// Weight at a distance of at most `radius`, times `measure`; may be negative where there is a correction.
  double operator()(float distance2) const { return isUniform_ ? 1 : weight(distance2); }

 private:
  static constexpr std::size_t kTerms = 5;
  using Polynomial = std::array<double, kTerms>;  ///< by powers, the lowest first
  static Polynomial shapeOf(KernelShape shape);
  static double valueOf(const Polynomial& p, double x);
  double weight(float distance2) const;

  bool isUniform_;
  double radius_;
  Polynomial base_;
  double inner_ = 0, outer_ = 0;              ///< radii of the correction; 0: there is none
  Polynomial withinInner_{}, beyondInner_{};  ///< of the distance over `outer_`
};

using DiscKernel = PhotonKernel<2>;
using BallKernel = PhotonKernel<3>;
extern template class PhotonKernel<2>;
extern template class PhotonKernel<3>;

}  // namespace pbrtmedia
