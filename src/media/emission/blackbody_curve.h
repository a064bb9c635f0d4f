// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Colour of a black body of peak 1 by temperature, from a table up to a highest temperature: linear between
/// temperatures in geometric steps, within 1e-3 of the exact colour (relative to its largest channel) from
/// 800 K on. Negative channels are cut; black up to kDark.
class BlackbodyCurve {
 public:
  static constexpr float kDark = 100;  ///< kelvin; even at ten times that nothing is seen but red

  /// `hottest`: kelvin, finite; temperatures beyond have its colour.
  explicit BlackbodyCurve(float hottest);
  Rgb at(float kelvin) const;
  /// Largest channel at this or any lower temperature.
  float upper(float kelvin) const;
  std::size_t bytes() const { return colours_.size() * (sizeof(Rgb) + sizeof(float)); }

 private:
  static constexpr std::size_t kSteps = 2048;
  /// Number of the step that holds the temperature, and where in it.
  struct Place {
    std::size_t step;
    float inside;
  };
  Place placeOf(float kelvin) const;

  float hottest_, perOctave_ = 0;  ///< steps per factor e of temperature
  std::vector<Rgb> colours_;       ///< kSteps + 1 of them; none when all is dark
  std::vector<float> uppers_;
};

}  // namespace pbrtmedia
