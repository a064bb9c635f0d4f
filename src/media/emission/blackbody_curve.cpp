// SPDX-License-Identifier: BSD-2-Clause
#include "media/emission/blackbody_curve.h"

#include <algorithm>
#include <cmath>

#include "spectrum/spectrum.h"

namespace pbrtmedia {

BlackbodyCurve::BlackbodyCurve(float hottest) : hottest_(hottest) {
  if (!(hottest > kDark)) return;
  const double range = std::log(static_cast<double>(hottest) / static_cast<double>(kDark));
  perOctave_ = static_cast<float>(static_cast<double>(kSteps) / range);
  float most = 0;
  for (std::size_t i = 0; i <= kSteps; ++i) {
    const double t =
        static_cast<double>(kDark) * std::exp(range * static_cast<double>(i) / static_cast<double>(kSteps));
    colours_.push_back(blackbodyToRgb(static_cast<float>(t), 1).nonNegative());
    most = std::max(most, colours_.back().max());
    uppers_.push_back(most);
  }
}

BlackbodyCurve::Place BlackbodyCurve::placeOf(float kelvin) const {
  const float at = std::log(std::min(kelvin, hottest_) / kDark) * perOctave_;
  const auto step = std::min(static_cast<std::size_t>(std::max(at, 0.0f)), kSteps - 1);
  return {step, std::clamp(at - static_cast<float>(step), 0.0f, 1.0f)};
}

Rgb BlackbodyCurve::at(float kelvin) const {
  if (!(kelvin > kDark) || colours_.empty()) return {};
  const Place place = placeOf(kelvin);
  return lerp(place.inside, colours_[place.step], colours_[place.step + 1]);
}

float BlackbodyCurve::upper(float kelvin) const {
  if (!(kelvin > kDark) || colours_.empty()) return 0;
  return uppers_[placeOf(kelvin).step + 1];
}

}  // namespace pbrtmedia
