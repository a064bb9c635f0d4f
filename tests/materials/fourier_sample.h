// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

// Files of tabulated BSDFs, made here.

namespace pbrtmedia::test {

/// One entry is a series of up to three orders for each channel, of the cosines muI and muO.
struct FourierSample {
  std::uint32_t flags = 1, channels = 1, bases = 1;
  float eta = 1.5f;
  std::vector<float> cosines;
  float reflectance = 0.6f, transmittance = 0.3f;
  float azimuthal = 0.4f;  ///< of cos(phi), relative to the mean

  /// Lambert's law on both sides, with an azimuth: f |muI| = R |muI| / π (1 + a sinI sinO cos(phi)).
  std::string bytes() const {
    const auto n = static_cast<std::uint32_t>(cosines.size());
    std::vector<float> coefficients;
    std::string pairs;
    for (const float muO : cosines) {
      for (const float muI : cosines) {
        const float albedo = muI * muO < 0 ? reflectance : transmittance;
        const float mean = albedo * std::abs(muI) * std::numbers::inv_pi_v<float>;
        const float sines = std::sqrt((1 - muI * muI) * (1 - muO * muO));
        append(pairs, static_cast<std::uint32_t>(coefficients.size()));
        append(pairs, 2u);
        for (std::uint32_t c = 0; c < channels; ++c) {
          const float tinted = mean * (1 - 0.2f * static_cast<float>(c));
          coefficients.insert(coefficients.end(), {tinted, tinted * azimuthal * sines});
        }
      }
    }
    std::string text("SCATFUN\x01", 8);
    for (const std::uint32_t number :
         {flags, n, static_cast<std::uint32_t>(coefficients.size()), 2u, channels, bases, 0u, 0u, 0u}) {
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

/// Cosines from -1 to 1, `n` on each side; none is 0, where Lambert's law has its bend.
inline std::vector<float> fourierCosines(int n) {
  std::vector<float> cosines;
  for (int i = -n; i <= n; ++i) {
    const float mu = static_cast<float>(i) / static_cast<float>(n);
    if (i == 0) {
      cosines.insert(cosines.end(), {-1e-4f, 1e-4f});
    } else {
      cosines.push_back(mu);
    }
  }
  return cosines;
}

}  // namespace pbrtmedia::test
