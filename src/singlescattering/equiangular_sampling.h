// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "singlescattering/lit_stretch.h"
#include "singlescattering/sampling_traits.h"
#include "singlescattering/stretch_sample.h"

namespace pbrtmedia {

/// On every stretch a light, and a distance with density proportional to 1/r² from it.
struct EquiangularSampling {
  static constexpr std::string_view kName = "equiangular";

  MediumLightSamplingTraits traits() const {
    return {.summary =
                "on every stretch a distance with density proportional to 1/r² from the light, within the "
                "cone of a spot light or the picture of a projector",
            .source = "Kulla & Fajardo 2012, section 4.1",
            .useWhen = "lights are in or near thin media"};
  }

  std::optional<StretchSample> sample(const LitStretch& stretch, Point2f u) const {
    return stretch.lights.sample(wholeOf(stretch), u.x, u.y);
  }
  double weight(const StretchSample& sample, const CollisionDensity&) const { return 1 / sample.pdf; }
  double collisionShare(const LitStretch&, std::size_t, double, const CollisionDensity&) const { return 0; }

  /// The stretch as its lights see it, none of them left out.
  static PositionLights::Stretch wholeOf(const LitStretch& s) {
    return {s.media.ray(), s.media.tMin(), s.media.tMax()};
  }
};

}  // namespace pbrtmedia
