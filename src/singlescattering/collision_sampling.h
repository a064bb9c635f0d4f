// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "singlescattering/lit_stretch.h"
#include "singlescattering/sampling_traits.h"
#include "singlescattering/stretch_sample.h"

namespace pbrtmedia {

/// Where the path collides, and nowhere else.
struct CollisionSampling {
  static constexpr std::string_view kName = "collision";

  MediumLightSamplingTraits traits() const {
    return {.summary = "where the path collides, as in PBRT-v3",
            .source = "Pharr, Jakob & Humphreys 2016, section 15.3.1",
            .useWhen = "lights are far away or media dense, or PBRT-v3's noise is wanted",
            .onStretches = false,
            .followsLights = false};
  }

  std::optional<StretchSample> sample(const LitStretch&, Point2f) const { return std::nullopt; }
  double weight(const StretchSample& sample, const CollisionDensity&) const { return 1 / sample.pdf; }
  double collisionShare(const LitStretch&, std::size_t, double, const CollisionDensity&) const { return 1; }
};

}  // namespace pbrtmedia
