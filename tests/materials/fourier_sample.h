// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

// Files of tabulated BSDFs, made here.

namespace pbrtmedia::test {

/// Of a table of series, one for each pair of cosines and channel.
struct FourierFile {
  std::uint32_t flags = 1, channels = 1, bases = 1;
  float eta = 1.5f;
  std::vector<float> cosines;

  /// seriesOf(muI, muO): one after the other, the coefficients of all channels.
  template <class SeriesOf>
  std::string bytes(const SeriesOf& seriesOf) const {
    const auto n = static_cast<std::uint32_t>(cosines.size());
    std::vector<float> coefficients;
    std::string pairs;
    std::uint32_t orders = 0;
    for (const float muO : cosines) {
      for (const float muI : cosines) {
        const std::vector<float> series = seriesOf(muI, muO);
        const auto length = static_cast<std::uint32_t>(series.size()) / channels;
        append(pairs, static_cast<std::uint32_t>(coefficients.size()));
        append(pairs, length);
        orders = std::max(orders, length);
        coefficients.insert(coefficients.end(), series.begin(), series.end());
      }
    }
    std::string text("SCATFUN\x01", 8);
    for (const std::uint32_t number :
         {flags, n, static_cast<std::uint32_t>(coefficients.size()), orders, channels, bases, 0u, 0u, 0u}) {
      append(text, number);
    }
    append(text, std::bit_cast<std::uint32_t>(eta));
    text.append(16, '\0');
    for (const float mu : cosines) append(text, std::bit_cast<std::uint32_t>(mu));
    text.append(std::size_t{4} * n * n, '\0');  // integrals
    text += pairs;
    for (const float a : coefficients) append(text, std::bit_cast<std::uint32_t>(a));
    return text;
  }

  static void append(std::string& text, std::uint32_t number) {
    for (int i = 0; i < 4; ++i) text += static_cast<char>(number >> (8 * i) & 255u);
  }
};

/// One entry is a series of two orders for each channel, of the cosines muI and muO.
struct FourierSample {
  std::uint32_t flags = 1, channels = 1, bases = 1;
  float eta = 1.5f;
  std::vector<float> cosines;
  float reflectance = 0.6f, transmittance = 0.3f;
  float azimuthal = 0.4f;  ///< of cos(phi), relative to the mean

  /// Lambert's law on both sides, with an azimuth: f |muI| = R |muI| / π (1 + a sinI sinO cos(phi)).
  std::string bytes() const {
    return FourierFile{flags, channels, bases, eta, cosines}.bytes([&](float muI, float muO) {
      const float albedo = muI * muO < 0 ? reflectance : transmittance;
      const float mean = albedo * std::abs(muI) * std::numbers::inv_pi_v<float>;
      const float sines = std::sqrt((1 - muI * muI) * (1 - muO * muO));
      std::vector<float> series;
      for (std::uint32_t c = 0; c < channels; ++c) {
        const float tinted = mean * (1 - 0.2f * static_cast<float>(c));
        series.insert(series.end(), {tinted, tinted * azimuthal * sines});
      }
      return series;
    });
  }
};

/// A rough mirror without loss on both sides: facets by Trowbridge & Reitz 1975 of roughness `alpha`, which
/// Smith's shadowing hides. What it returns is less than 1 by the light that would meet a second facet.
struct FourierMirror {
  float alpha = 0.5f;
  int orders = 24;

  double smith(double mu) const {
    const double tangent2 = (1 - mu * mu) / (mu * mu);
    return (std::sqrt(1 + alpha * alpha * tangent2) - 1) / 2;
  }
  /// f |muI|, for cosines of light and view to the normal on one side, `phi` away from the mirror direction.
  double value(double muI, double muO, double phi) const {
    const double sinI = std::sqrt(1 - muI * muI), sinO = std::sqrt(1 - muO * muO);
    const double x = sinI - sinO * std::cos(phi), y = sinO * std::sin(phi), z = muI + muO;
    const double cosine2 = z * z / (x * x + y * y + z * z), a2 = double{alpha} * double{alpha};
    const double t = cosine2 * (a2 - 1) + 1;
    const double facets = a2 / (std::numbers::pi * t * t);
    return facets / (1 + smith(muI) + smith(muO)) / (4 * muO);
  }
  std::string bytes(const std::vector<float>& cosines) const {
    FourierFile file;
    file.cosines = cosines;
    return file.bytes([&](float muI, float muO) {
      std::vector<float> series;
      if (muI * muO > 0) return series;
      const int points = 4 * orders;  // of the whole circle: more than twice the orders
      for (int k = 0; k < orders; ++k) {
        double sum = 0;
        for (int i = 0; i < points; ++i) {
          const double phi = 2 * std::numbers::pi * (i + 0.5) / points;
          sum += value(std::abs(double{muI}), std::abs(double{muO}), phi) * std::cos(k * phi);
        }
        series.push_back(static_cast<float>((k == 0 ? 1 : 2) * sum / points));
      }
      return series;
    });
  }
};

/// Cosines from -1 to 1, `n` on each side; none is 0, where Lambert's law has its bend. `isSharp`: with a
/// second one beside it, so that splines of what the sides differ in are straight from there on.
inline std::vector<float> fourierCosines(int n, bool isSharp = false) {
  std::vector<float> cosines;
  for (int i = -n; i <= n; ++i) {
    const float mu = static_cast<float>(i) / static_cast<float>(n);
    if (i == 0) {
      if (isSharp) cosines.push_back(-2e-4f);
      cosines.insert(cosines.end(), {-1e-4f, 1e-4f});
      if (isSharp) cosines.push_back(2e-4f);
    } else {
      cosines.push_back(mu);
    }
  }
  return cosines;
}

}  // namespace pbrtmedia::test
