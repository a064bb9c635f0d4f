// SPDX-License-Identifier: BSD-2-Clause
#include "spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "spectrum/cie1931.h"

namespace pbrtmedia {
namespace {

struct Xyz {
  double x = 0, y = 0, z = 0;
};

Rgb toRgb(const Xyz& c) {
  return {static_cast<float>(3.240479 * c.x - 1.537150 * c.y - 0.498535 * c.z),
          static_cast<float>(-0.969256 * c.x + 1.875991 * c.y + 0.041556 * c.z),
          static_cast<float>(0.055648 * c.x - 0.204043 * c.y + 1.057311 * c.z)};
}

/// X = k Σ S(λi) x̄(λi), k = (830 - 360) / (106.856895 · 471), for `curve` taking nm in ascending order.
template <class Curve>
Rgb integrate(Curve&& curve) {
  Xyz sum;
  double wavelength = kCieFirstWavelength;
  for (const Cie1931Entry& matching : cie1931()) {
    const double s = curve(wavelength);
    sum.x += s * matching.x;
    sum.y += s * matching.y;
    sum.z += s * matching.z;
    wavelength += 1;
  }
  constexpr double k =
      (kCieLastWavelength - kCieFirstWavelength) / (kCieYIntegral * static_cast<double>(kCieSampleCount));
  return toRgb({k * sum.x, k * sum.y, k * sum.z});
}

void requireUsable(const std::vector<SpectralSample>& sorted) {
  if (sorted.empty()) throw std::invalid_argument("a sampled spectrum needs at least one sample");
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    if (sorted[i].wavelength == sorted[i + 1].wavelength) {
      std::ostringstream message;
      message << "wavelength " << sorted[i].wavelength << " nm appears more than once";
      throw std::invalid_argument(message.str());
    }
  }
}

/// Linear interpolation between sorted samples, for wavelengths asked in ascending order.
class AscendingCurve {
 public:
  explicit AscendingCurve(const std::vector<SpectralSample>& samples) : samples_(samples) {}
  double operator()(double wavelength) {
    while (next_ < samples_.size() && static_cast<double>(samples_[next_].wavelength) <= wavelength) ++next_;
    if (next_ == 0) return static_cast<double>(samples_.front().value);
    if (next_ == samples_.size()) return static_cast<double>(samples_.back().value);
    const SpectralSample &a = samples_[next_ - 1], &b = samples_[next_];
    const double la = static_cast<double>(a.wavelength), lb = static_cast<double>(b.wavelength);
    const double t = (wavelength - la) / (lb - la);
    return (1 - t) * static_cast<double>(a.value) + t * static_cast<double>(b.value);
  }

 private:
  const std::vector<SpectralSample>& samples_;
  std::size_t next_ = 0;  ///< first sample beyond the last wavelength asked for
};

}  // namespace

Rgb xyzToRgb(Rgb xyz) {
  return toRgb({static_cast<double>(xyz.r), static_cast<double>(xyz.g), static_cast<double>(xyz.b)});
}

Rgb sampledSpectrumToRgb(std::vector<SpectralSample> samples) {
  for (const SpectralSample& s : samples) {
    // Before sorting: a NaN wavelength has no order.
    if (!std::isfinite(s.wavelength) || !std::isfinite(s.value)) {
      throw std::invalid_argument("a sampled spectrum has a wavelength or value that is not finite");
    }
  }
  std::sort(samples.begin(), samples.end(),
            [](const SpectralSample& a, const SpectralSample& b) { return a.wavelength < b.wavelength; });
  requireUsable(samples);
  return integrate(AscendingCurve(samples));
}

Rgb blackbodyToRgb(float kelvin, float scale) {
  if (!(kelvin > 0) || !std::isfinite(kelvin) || !std::isfinite(scale)) {
    std::ostringstream message;
    message << "a black body needs a finite temperature above 0 and a finite scale, found " << kelvin
            << " K and " << scale;
    throw std::invalid_argument(message.str());
  }
  constexpr double c = 299792458, h = 6.62606957e-34, kb = 1.3806488e-23;  // CODATA 2010, SI units
  constexpr double wien = 2.8977721e-3;                                    // m K
  constexpr double hcOverK = h * c / kb;                                   // m K
  const double t = static_cast<double>(kelvin), peak = wien / t;
  // B(λ)/B(λ_max) = (λ_max/λ)^5 (e^{hc/(λ_max k T)} - 1) / (e^{hc/(λ k T)} - 1): no factor over- or
  // underflows for any float T before the quotient itself does.
  const double peakTerm = std::expm1(hcOverK / wien);
  return integrate([&](double nanometres) {
    const double wavelength = nanometres * 1e-9;
    const double term = std::expm1(hcOverK / (wavelength * t));
    if (std::isinf(term)) return 0.0;
    return static_cast<double>(scale) * std::pow(peak / wavelength, 5) * (peakTerm / term);
  });
}

}  // namespace pbrtmedia
