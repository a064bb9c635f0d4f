// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "media/paired_transmittance.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// How light samples and scattered directions share the light of one direction, where it comes through media.
///
/// Both find f T L: a light sample as f L T^ / light, T^ an estimate of the transmittance T, and a scattered
/// direction as f L / scattering times what is left of a path that flies through the media, which is 1 with
/// probability T. Shares w that add up to one keep the sum right, and the sum of the second moments,
///   w_l² E[T^²] / light + w_s² T / scattering,
/// is least where w_s / w_l = q scattering / light, q = E[T^²] / T: between T, where T^ is exact, and 1,
/// where it is as noisy as a flight. (The balance heuristic of Veach & Guibas 1995 with second moments:
/// Grittmann et al. 2019, doi:10.1145/3355089.3356515.) Directions alone, q = 1, trust flights in dense media
/// too much. Shares are those of the power heuristic of light and q scattering.
///
/// T is known only by estimates, complex numbers z = value + i spread (PairedTransmittance). A share from the
/// very estimate that it multiplies would be correlated with it, and what both strategies find would not add
/// up to T. So there are two forms:
///
/// - Independent: q from one estimate, T^ from another, and once more with both exchanged. Scattered
///   directions take an estimate of their own, of the same distribution. Then E[w_l(a) T^(b)] = E[w_l] T and
///   T E[1 - w_l(c)] add up to T whatever the noise: no bias but that of T^. So does a q that is not random
///   at all, such as one from bounds.
/// - Joint: one estimate for both, by the jackknife: of a function F that is analytic, Re F(z) has the mean
///   F(T) if the optical depths of the two halves are normal, F(T^) has not. F(T) = T w_l(T) is what light
///   samples find, w_s(T) what scattered directions are multiplied by, with q = T. Peters 2025. Biased where
///   the halves are not normal, by third cumulants, and by the full covariance where an estimator tells no
///   spread.
class TransmittanceShares {
 public:
  /// Densities with which both choose the direction, per solid angle; positive.
  TransmittanceShares(double light, double scattering) : ratio_(std::min(scattering / light, kMostRatio)) {}

  /// Independent: T w_l.
  Rgb litThrough(const PairedTransmittance& a, const PairedTransmittance& b) const {
    return 0.5f * (lightShare(a) * b.value + lightShare(b) * a.value);
  }
  /// Independent: w_l and w_s.
  Rgb lightShare(const PairedTransmittance& estimate) const { return Rgb(1) - scatteringShare(estimate); }
  Rgb scatteringShare(const PairedTransmittance& estimate) const {
    return perChannel(
        [&](std::size_t c) { return ofScattering(secondMoment(estimate.value[c], estimate.spread[c])); });
  }
  /// Joint: T w_l.
  Rgb jointLitThrough(const PairedTransmittance& estimate) const {
    return perChannel([&](std::size_t c) {
      const std::complex<double> z(estimate.value[c], estimate.spread[c]);
      if (!isTame(z)) return z.real() * (1 - ofScattering(secondMoment(z.real(), z.imag())));
      return (z / (1.0 + square(ratio_ * z))).real();
    });
  }
  /// Joint: w_s.
  Rgb jointScatteringShare(const PairedTransmittance& estimate) const {
    return perChannel([&](std::size_t c) {
      const std::complex<double> z(estimate.value[c], estimate.spread[c]);
      if (!isTame(z)) return ofScattering(secondMoment(z.real(), z.imag()));
      const std::complex<double> odds = square(ratio_ * z);
      return (odds / (1.0 + odds)).real();
    });
  }

  /// An estimate of q from one of the transmittance, in [0, 1]: value² + spread² over the value, of which the
  /// first is the mean square of what is to be multiplied. Nothing known: 0.
  static double secondMoment(double value, double spread) {
    const double mean = std::abs(value), square = value * value + spread * spread;
    return square < mean ? square / mean : (square > 0 ? 1 : 0);
  }

 private:
  /// The power heuristic.
  double ofScattering(double q) const {
    const double odds = square(ratio_ * q);
    return odds / (1 + odds);
  }
  /// Elsewhere halves are too far apart to be normal, and the denominators of F may vanish.
  static bool isTame(std::complex<double> z) { return z.real() > 0 && std::abs(z.imag()) <= z.real(); }

  template <class Function>
  static Rgb perChannel(const Function& f) {
    Rgb result;
    for (std::size_t c = 0; c < 3; ++c) result[c] = static_cast<float>(f(c));
    return result;
  }

  /// Beyond it light samples have no share that a float could tell from 0.
  static constexpr double kMostRatio = 1e60;
  template <class T>
  static T square(T x) {
    return x * x;
  }

  double ratio_;  ///< of the densities, that of scattering in the numerator
};

}  // namespace pbrtmedia
